// The walkthrough from its first line to its last: the scene, the window, the map, the frames; a scene that is loaded
// anew with other photometric files, a device that is lost.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "shaders/types.h"

namespace lw {

struct WalkthroughSettings {
    std::filesystem::path scene, map;
    std::filesystem::path output;  // folder of what is saved
    DeviceSettings device;
    vk::Extent2D size{1280, 720};
    std::string camera, ambiance;
    std::vector<std::string> photometry;  // "LAMP=FILE", beside those of SCENE.ambiances.json
    uint64_t photons = 1'000'000;         // of a map that must be baked
    bool vsync = true;
};

/// Opens the window and returns when it is closed. A lost device is started again once a minute. Throws Error when
/// there is no scene, no display or no device.
void walk_in_window(const WalkthroughSettings& settings);

}  // namespace lw
