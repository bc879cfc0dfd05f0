// The window's loop: events, a step of the walk, a frame.
#pragma once
#include "app/baking.h"
#include "app/overlay.h"
#include "app/session.h"

namespace lw {

struct WalkthroughSettings {
    std::filesystem::path scene, map;
    std::filesystem::path output;  // folder of what is saved
    DeviceSettings device;
    vk::Extent2D size{1280, 720};
    std::string camera, ambiance;
    uint64_t photons = 1'000'000;  // of a map that must be baked
    bool vsync = true;
};

/// Opens the window and returns when it is closed. A lost device is started again once a minute. Throws Error when
/// there is no scene, no display or no device.
void walk_in_window(const WalkthroughSettings& settings);

}  // namespace lw
