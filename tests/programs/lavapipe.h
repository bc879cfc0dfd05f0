// Mesa's Vulkan on the CPU: the one device whose pictures are the same on every machine.
#pragma once
#include "gpu/device.h"

namespace lw {

inline bool has_lavapipe() {
    for (const std::string& name : device_names())
        if (name.find("llvmpipe") != std::string::npos) return true;
    return false;
}

}  // namespace lw

#define SKIP_WITHOUT_LAVAPIPE() \
    if (!lw::has_lavapipe()) GTEST_SKIP() << "no lavapipe here: install mesa-vulkan-drivers"
