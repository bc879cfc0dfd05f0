// WebP pictures in; the only user of libwebp.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lw {

struct WebpImage {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  // 4 bytes a pixel, row 0 on top; sRGB codes and alpha as in the file
};

/// True when the bytes begin as a WebP file does.
bool is_webp(std::span<const uint8_t> bytes);

/// Decodes a lossy or lossless WebP picture; of an animation nothing. Nothing when the bytes are damaged. Without
/// `decode_pixels` only the size is read.
std::optional<WebpImage> decode_webp(std::span<const uint8_t> bytes, bool decode_pixels = true);

}  // namespace lw
