// The walkthrough as a whole: loads the scene, opens the window, finds or bakes the map and shows frames. Loads the
// scene again when photometric files change, and starts again on a new device when one is lost.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "shaders/types.h"

namespace lw {

struct WalkthroughSettings {
    std::filesystem::path scene, map;
    std::filesystem::path output;  // folder for files that the user saves
    DeviceSettings device;
    vk::Extent2D size{1280, 720};
    std::string camera, ambiance;
    std::vector<std::string> photometry;  // "LAMP=FILE", beside those of SCENE.ambiances.json
    uint64_t photons = 1'000'000;         // photons of a map that has to be baked
    bool vsync = true;
};

/// Opens the window and returns when it is closed. After the loss of a device it starts again, at most once a minute.
/// Throws Error when there is no scene, no display or no device.
void walk_in_window(const WalkthroughSettings& settings);

}  // namespace lw
