#include "maps/packing.h"

#include <algorithm>
#include <cmath>

namespace lw {

uint pack_rgb9e5(vec3 color) {
    constexpr float largest = 65408;  // (2^9 - 1) / 2^9 * 2^16
    const auto bounded = [=](float v) { return v > 0 ? std::min(v, largest) : 0.0f; };
    const vec3 c(bounded(color.x), bounded(color.y), bounded(color.z));
    const float top = std::max({c.x, c.y, c.z});
    if (!(top > 0)) return 0;
    const auto steps_per_unit = [](int biased) { return uintBitsToFloat(uint(127 + 24 - biased) << 23); };
    int exponent = std::max(-16, int(floatBitsToUint(top) >> 23) - 127) + 16;
    if (top * steps_per_unit(exponent) + 0.5f >= 512) ++exponent;
    const float scale = steps_per_unit(exponent);
    const auto mantissa = [=](float v) { return std::min(uint(v * scale + 0.5f), 511u); };
    return mantissa(c.x) | mantissa(c.y) << 9 | mantissa(c.z) << 18 | uint(exponent) << 27;
}

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
