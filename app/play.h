// Replays a recorded walk frame by frame, without a window: pictures, times, or both.
#pragma once
#include "app/session/session.h"

namespace lw {

struct PlaySettings {
    std::filesystem::path scene, map, path;
    std::filesystem::path frames;   // folder of frame-0001.png ...; empty: none
    std::filesystem::path timings;  // CSV of milliseconds per frame and pass; empty: none
    DeviceSettings device;
    vk::Extent2D size{960, 540};
    std::string ambiance;
    std::vector<std::string> photometry;  // "LAMP=FILE", beside those of SCENE.ambiances.json
    GatherSettings gather;
    std::optional<float> exposure_ev;  // EV100; nothing: adapts to the picture
    uint samples = 1;                  // views averaged per frame
    uint divisor = 1;                  // divides width and height; 0: chosen from the frame times, as in the window
};

/// Renders every frame of the path with `samples` samples and prints the rate. Frames are made one after the other; the
/// times leave out reading back and writing. Throws Error naming the path, map or file that fails.
void play(const PlaySettings& settings);

}  // namespace lw
