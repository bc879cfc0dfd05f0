// Pictures to and from OpenEXR files (openexr.com, version 3.1); the only user of that library. In and out: an Image,
// row 0 on top, every channel under its own name. Values are unchanged, except that 16-bit channels are rounded.
#pragma once
#include <filesystem>

#include "image/image.h"

namespace lw {

/// Writes `image` beside `path`, then renames it into place. ZIP compression, scan lines, one part.
/// Channels with `half` are rounded to 16 bits and clamped to +-65504, the others keep their 32 bits.
/// Throws Error naming the file when it cannot be written. Channel names are distinct and not empty.
void write_exr(const std::filesystem::path& path, const Image& image);

/// Reads the first part of a scan line or tiled file. The Image is the data window, wherever that lies;
/// channels come in alphabetical order, UINT ones as floats. Throws Error naming the file when it is missing, damaged,
/// cut short, not a flat picture, larger than 2^30 samples, or has a subsampled channel.
Image read_exr(const std::filesystem::path& path);

}  // namespace lw
