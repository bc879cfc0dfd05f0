#pragma once
#include <webp/encode.h>

#include <cstdint>
#include <vector>

namespace lw::test {

/// A lossless WebP file of one row of RGBA pixels.
inline std::vector<unsigned char> webp_row(const std::vector<uint8_t>& rgba) {
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(rgba.data(), int(rgba.size() / 4), 1, int(rgba.size()), &encoded);
    const std::vector<unsigned char> bytes(encoded, encoded + size);
    WebPFree(encoded);
    return bytes;
}

}  // namespace lw::test
