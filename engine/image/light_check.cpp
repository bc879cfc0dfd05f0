#include "image/light_check.h"

#include <cmath>

#include "base/error.h"

namespace lw {

void check_is_light(const Image& image) {
    for (const char* name : {"R", "G", "B", "illuminance"}) {
        const Channel* channel = image.find(name);
        if (!channel) continue;
        for (size_t i = 0; i < channel->values.size(); ++i) {
            const float value = channel->values[i];
            if (std::isfinite(value) && value >= 0) continue;
            throw Error("the picture is not written: " + std::string(name) + " at pixel (" +
                        std::to_string(i % size_t(image.width)) + ", " + std::to_string(i / size_t(image.width)) +
                        ") is " + std::to_string(value) + ", which is no light");
        }
    }
}

}  // namespace lw
