// Display pictures to and from PNG files; the only user of stb.
// In and out: sRGB codes of 8 bits, three per pixel, row 0 on top. No colour conversion here.
#pragma once
#include <filesystem>
#include <optional>
#include <span>

#include "image/rgb8_image.h"

namespace lw {

/// Writes `image` beside `path`, then renames it into place. Throws Error naming the file when it cannot be written.
void write_png(const std::filesystem::path& path, const Rgb8Image& image);

/// The bytes of a PNG file.
std::vector<uint8_t> encode_png(const Rgb8Image& image);

/// Reads any PNG (or other picture that stb_image knows) as 8-bit RGB: alpha is dropped, grey repeated. Throws Error
/// naming the file when it is missing or damaged.
Rgb8Image read_png(const std::filesystem::path& path);

struct PictureSize {
    int width = 0, height = 0;
};

/// The size that a WebP, PNG, JPEG, BMP or other picture that stb_image knows gives of itself, without decoding it;
/// nothing when it is none of these or larger than 1 GiB.
std::optional<PictureSize> size_of_encoded(std::span<const uint8_t> bytes);

}  // namespace lw
