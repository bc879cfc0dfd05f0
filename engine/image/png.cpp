#include "image/png.h"

#include <cassert>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/input_file.h"
#include "base/replaced_file.h"
#include "image/webp.h"

// Static: libtinygltf.so exports the same symbols.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

namespace lw {
namespace {

void append(void* stream, void* bytes, int size) {
    static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(bytes), size);
}

void append_bytes(void* to, void* bytes, int size) {
    const auto* first = static_cast<const uint8_t*>(bytes);
    auto& all = *static_cast<std::vector<uint8_t>*>(to);
    all.insert(all.end(), first, first + size);
}

std::vector<uint8_t> read_bytes(const std::filesystem::path& path) {
    std::ifstream stream = open_input(path);
    if (!stream) throw Error(path.string() + ": cannot be opened");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

void write_png(const std::filesystem::path& path, const Rgb8Image& image) {
    assert(image.rgb.size() == 3 * image.pixel_count());
    ReplacedFile file(path);
    int stride = 3 * image.width;
    if (!stbi_write_png_to_func(append, &file.stream(), image.width, image.height, 3, image.rgb.data(), stride))
        throw Error(path.string() + ": cannot be encoded as PNG");
    file.commit();
}

std::vector<uint8_t> encode_png(const Rgb8Image& image) {
    assert(image.rgb.size() == 3 * image.pixel_count());
    std::vector<uint8_t> bytes;
    if (!stbi_write_png_to_func(append_bytes, &bytes, image.width, image.height, 3, image.rgb.data(), 3 * image.width))
        throw Error("a picture cannot be encoded as PNG");
    return bytes;
}

Rgb8Image read_png(const std::filesystem::path& path) {
    std::vector<uint8_t> bytes = read_bytes(path);
    if (bytes.size() > size_t(1) << 30) throw Error(path.string() + ": larger than 1 GiB");
    Rgb8Image image;
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &image.width, &image.height, nullptr, 3),
        stbi_image_free);
    if (!pixels) throw Error(path.string() + ": not a readable PNG: " + stbi_failure_reason());
    image.rgb.assign(pixels.get(), pixels.get() + 3 * image.pixel_count());
    return image;
}

std::optional<PictureSize> size_of_encoded(std::span<const uint8_t> bytes) {
    if (is_webp(bytes)) {
        const std::optional<WebpImage> image = decode_webp(bytes, false);
        return image ? std::optional(PictureSize{image->width, image->height}) : std::nullopt;
    }
    PictureSize size;
    if (bytes.size() > size_t(1) << 30 ||
        !stbi_info_from_memory(bytes.data(), int(bytes.size()), &size.width, &size.height, nullptr))
        return {};
    return size;
}

}  // namespace lw
