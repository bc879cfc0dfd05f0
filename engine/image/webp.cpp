#include "image/webp.h"

#include <webp/decode.h>

#include <cstring>

namespace lw {

bool is_webp(std::span<const uint8_t> bytes) {
    return bytes.size() >= 12 && !std::memcmp(bytes.data(), "RIFF", 4) && !std::memcmp(bytes.data() + 8, "WEBP", 4);
}

std::optional<WebpImage> decode_webp(std::span<const uint8_t> bytes, bool decode_pixels) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK || features.has_animation) return {};
    WebpImage image{features.width, features.height, {}};
    if (!decode_pixels) return image;
    const size_t row_bytes = 4 * size_t(image.width);
    image.rgba.resize(row_bytes * size_t(image.height));
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.rgba.data(), image.rgba.size(), int(row_bytes)))
        return {};
    return image;
}

}  // namespace lw
