#include "maps/packing.h"

#include <algorithm>
#include <cmath>

namespace lw {

uint16_t pack_direction(vec3 d, vec2 dither) {
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    float x = d.x / sum, y = d.y / sum;
    if (d.z < 0) {
        const float fx = (1 - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f), fy = (1 - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f);
        x = fx, y = fy;
    }
    const auto code = [](float v, float threshold) { return uint(clamp((v + 1) * 127 + threshold, 0.0f, 254.0f)); };
    return uint16_t(code(x, dither.x) | code(y, dither.y) << 8);
}

}  // namespace lw
