#include "scene/gltf_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "image/png.h"
#include "image/webp.h"
#include "scene/gltf_accessor.h"

namespace lw {
namespace {

constexpr uint64_t decoding_bytes = 12;  // per pixel while decoding: the unpacked picture, its RGBA form and a copy

uint wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return wrap_clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? wrap_mirror : wrap_repeat;
}

/// KHR_texture_transform: uv' = translation * rotation * scale * uv.
void read_transform(const tinygltf::Value& transform, TextureSlot& slot) {
    const auto pair = [&](const char* key, double otherwise) {
        if (!transform.Has(key) || transform.Get(key).ArrayLen() != 2) return glm::dvec2(otherwise);
        return glm::dvec2(transform.Get(key).Get(0).GetNumberAsDouble(), transform.Get(key).Get(1).GetNumberAsDouble());
    };
    const glm::dvec2 offset = pair("offset", 0), scale = pair("scale", 1);
    const double angle = number_of(transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
    slot.row0 = vec3(c * scale.x, s * scale.y, offset.x);
    slot.row1 = vec3(-s * scale.x, c * scale.y, offset.y);
    slot.texcoord = uint(index_of(transform, "texCoord", int(slot.texcoord)));
}

std::span<const unsigned char> encoded_bytes(const GltfFile& file, const tinygltf::Image& image,
                                             const std::string& where) {
    if (image.bufferView >= 0) return read_view(file, image.bufferView, where);
    return image.image;
}

/// RGBA8 of a WebP, PNG, JPEG, BMP or other image stb_image knows; nothing when it does not.
std::optional<tinygltf::Image> decode(std::span<const unsigned char> bytes) {
    tinygltf::Image image;
    std::string error, warning;
    if (bytes.empty() || bytes.size() > size_t(std::numeric_limits<int>::max())) return {};
    if (is_webp(bytes)) {
        std::optional<WebpImage> webp = decode_webp(bytes);
        if (!webp) return {};
        image.width = webp->width, image.height = webp->height, image.component = 4, image.bits = 8;
        image.image = std::move(webp->rgba);
        return image;
    }
    if (!tinygltf::LoadImageData(&image, 0, &error, &warning, 0, 0, bytes.data(), int(bytes.size()), nullptr))
        return {};
    const bool known =
        image.component == 4 && (image.bits == 8 || image.bits == 16) && image.width > 0 && image.height > 0;
    if (!known || image.image.size() < size_t(image.width) * size_t(image.height) * 4 * size_t(image.bits / 8))
        return {};
    return image;
}

uint packed_texel(const tinygltf::Image& image, size_t texel) {
    const size_t step = size_t(image.bits / 8), high = step - 1;  // the high byte of a 16-bit channel
    uint bits = 0;
    for (size_t c = 0; c < 4; ++c) bits |= uint(image.image[(texel * 4 + c) * step + high]) << (8 * c);
    return bits;
}

/// The image of a texture: that of an extension whose format is decoded, else the plain one; -1 when there is none.
int image_of(const tinygltf::Texture& texture) {
    const tinygltf::Value* webp = extension_of(texture.extensions, "EXT_texture_webp");
    return webp ? index_of(*webp, "source", texture.source) : texture.source;
}

/// Linear value of an sRGB code (IEC 61966-2-1).
float linear_of(uint code) {
    const float c = float(code) / 255.0f;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

TextureSlot no_texture() { return {-1, 0, vec3(1, 0, 0), vec3(0, 1, 0)}; }

tinygltf::TextureInfo texture_info(const tinygltf::Value& extension, const std::string& key) {
    tinygltf::TextureInfo reference;
    if (!extension.Has(key) || !extension.Get(key).IsObject()) return reference;
    const tinygltf::Value& object = extension.Get(key);
    reference.index = index_of(object, "index", -1);
    reference.texCoord = index_of(object, "texCoord", 0);
    if (object.Has("extensions"))
        for (const std::string& name : object.Get("extensions").Keys())
            reference.extensions[name] = object.Get("extensions").Get(name);
    return reference;
}

TextureSlot TextureLoader::slot(const tinygltf::TextureInfo& reference, bool srgb, const std::string& where) {
    TextureSlot slot = no_texture();
    if (reference.index < 0) return slot;
    if (size_t(reference.index) >= file_.model.textures.size())
        file_.fail(where + ": there is no texture " + std::to_string(reference.index));
    slot.texcoord = uint(std::max(reference.texCoord, 0));
    if (const auto* transform = extension_of(reference.extensions, "KHR_texture_transform"))
        read_transform(*transform, slot);
    if (slot.texcoord > 1) {
        file_.warn(where + ": TEXCOORD_" + std::to_string(slot.texcoord) +
                   " is not supported, the texture is left out");
        return no_texture();
    }
    const tinygltf::Texture& source = file_.model.textures[size_t(reference.index)];
    if (image_of(source) < 0 && extension_of(source.extensions, "KHR_texture_basisu")) {
        file_.warn(where +
                   ": its picture is Basis Universal (KTX2), which is not decoded; its factor is used. Convert the "
                   "file by \"gltf-transform ktxdecompress\"");
        return slot;
    }
    slot.texture = texture(image_of(source), source.sampler, srgb, where);
    return slot;
}

int TextureLoader::texture(int image, int sampler, bool srgb, const std::string& where) {
    const auto [it, is_new] = textures_.try_emplace({image, sampler, srgb}, -1);
    if (!is_new) return it->second;
    const std::optional<Picture> found = picture(image, where);
    if (!found) return -1;
    Texture t{found->first_texel, found->width, found->height, wrap_repeat, wrap_repeat, srgb ? 1u : 0u, 0u};
    if (sampler >= 0) {
        if (size_t(sampler) >= file_.model.samplers.size())
            file_.fail(where + ": there is no sampler " + std::to_string(sampler));
        const tinygltf::Sampler& source = file_.model.samplers[size_t(sampler)];
        t.wrap_s = wrap_of(source.wrapS);
        t.wrap_t = wrap_of(source.wrapT);
        t.nearest = source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? 1u : 0u;
    }
    it->second = int(scene_.textures.size());
    scene_.textures.push_back(t);
    return it->second;
}

bool TextureLoader::is_black(const TextureSlot& slot) const {
    if (slot.texture < 0) return false;
    const Texture& t = scene_.textures[size_t(slot.texture)];
    const auto first = scene_.texels.begin() + t.first_texel;
    return std::all_of(first, first + size_t(t.width) * t.height, [](uint texel) { return (texel & 0xffffffu) == 0; });
}

GlossinessTexture TextureLoader::glossiness(const tinygltf::TextureInfo& reference, float factor,
                                            const std::string& where) {
    GlossinessTexture result{slot(reference, false, where), vec3(1)};
    if (result.roughness.texture < 0) return result;
    Texture texture = scene_.textures[size_t(result.roughness.texture)];
    const size_t source = texture.first_texel, count = size_t(texture.width) * texture.height;
    if (scene_.texels.size() + count > std::numeric_limits<uint>::max())
        file_.fail(where + ": the textures have more than 2^32 texels");
    texture.first_texel = uint(scene_.texels.size());
    glm::dvec3 sum(0);
    for (size_t i = 0; i < count; ++i) {
        const uint texel = scene_.texels[source + i];
        sum += glm::dvec3(linear_of(texel & 255u), linear_of((texel >> 8) & 255u), linear_of((texel >> 16) & 255u));
        const float roughness = 1 - factor * float(texel >> 24) / 255.0f;
        scene_.texels.push_back(uint(std::lround(255.0f * roughness)) << 8 | 0xff0000ffu);  // G; no metal in B
    }
    result.mean_specular = vec3(sum / double(count));
    result.roughness.texture = int(scene_.textures.size());
    scene_.textures.push_back(texture);
    return result;
}

std::optional<TextureLoader::Picture> TextureLoader::picture(int index, const std::string& where) {
    const auto [it, is_new] = pictures_.try_emplace(index);
    if (!is_new) return it->second;
    if (index < 0 || size_t(index) >= file_.model.images.size()) {
        file_.warn(where + ": has no image in a format that can be decoded; its factor is used");
        return {};
    }
    const tinygltf::Image& source = file_.model.images[size_t(index)];
    const std::string name = label("image", size_t(index), source.name);
    const std::span<const unsigned char> encoded = encoded_bytes(file_, source, name);
    if (const auto size = size_of_encoded(encoded)) {
        const uint64_t texels = uint64_t(size->width) * uint64_t(size->height);
        if (scene_.texels.size() + texels > std::numeric_limits<uint>::max())
            file_.fail(name + ": the textures have more than 2^32 texels");
        check_memory(file_, name + ": the textures",
                     (scene_.texels.size() + texels) * sizeof(scene_.texels[0]) + texels * decoding_bytes);
    }
    const std::optional<tinygltf::Image> decoded = decode(encoded);
    if (!decoded) {
        file_.warn(name +
                   (source.bufferView < 0 && source.image.empty() ? ": is missing"
                                                                  : ": cannot be decoded (PNG, JPEG and WebP can)") +
                   "; the factor of " + where + " is used instead");
        return {};
    }
    const size_t first = scene_.texels.size(), count = size_t(decoded->width) * size_t(decoded->height);
    scene_.texels.resize(first + count);
    for (size_t i = 0; i < count; ++i) scene_.texels[first + i] = packed_texel(*decoded, i);
    it->second = Picture{uint(first), uint(decoded->width), uint(decoded->height)};
    return it->second;
}

}  // namespace lw
