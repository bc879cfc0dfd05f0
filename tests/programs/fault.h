// Programs started while a Fault lives run on a device that fails as it says (tests/faults/fault_layer.cpp).
#pragma once
#include <cstdlib>
#include <string>

namespace lw {

class Fault {
  public:
    explicit Fault(const std::string& fault) {
        setenv("VK_ADD_LAYER_PATH", LUMENWALK_BINARY_DIR "/faults", 1);
        setenv("VK_INSTANCE_LAYERS", "VK_LAYER_LUMENWALK_faults", 1);
        setenv("LUMENWALK_FAULT", fault.c_str(), 1);
    }
    Fault(const Fault&) = delete;
    Fault& operator=(const Fault&) = delete;
    ~Fault() {
        for (const char* name : {"VK_ADD_LAYER_PATH", "VK_INSTANCE_LAYERS", "LUMENWALK_FAULT"}) unsetenv(name);
    }
};

}  // namespace lw
