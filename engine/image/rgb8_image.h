// A picture as a screen or a PNG holds it: sRGB codes, 8 bits, three per pixel, row 0 on top.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lw {

struct Rgb8Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgb;  // 3 * width * height

    size_t pixel_count() const { return size_t(width) * size_t(height); }
};

}  // namespace lw
