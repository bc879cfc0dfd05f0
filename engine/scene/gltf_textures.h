// glTF textures decoded to RGBA8 texels, each image once, each (image, sampler, encoding) one Texture record.
#pragma once
#include <map>
#include <optional>
#include <tuple>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace lw {

/// What a specular-glossiness texture says (KHR_materials_pbrSpecularGlossiness): RGB is a specular colour, A
/// glossiness.
struct GlossinessTexture {
    TextureSlot roughness;  // its G channel: 1 - factor x glossiness
    vec3 mean_specular;     // linear, mean of all texels
};

class TextureLoader {
  public:
    TextureLoader(GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The slot for a texture that a material refers to. `srgb`: its colours are sRGB encoded. The slot has texture =
    /// -1 when the material names none, or, with a warning, when the image cannot be used.
    TextureSlot slot(const tinygltf::TextureInfo& reference, bool srgb, const std::string& where);

    /// True when the texture of a slot is black everywhere.
    bool is_black(const TextureSlot& slot) const;

    /// The specular-glossiness texture of a material whose glossinessFactor is `factor`.
    GlossinessTexture glossiness(const tinygltf::TextureInfo& reference, float factor, const std::string& where);

  private:
    struct Picture {
        uint first_texel, width, height;
    };
    std::optional<Picture> picture(int image, const std::string& where);
    int texture(int image, int sampler, bool srgb, const std::string& where);

    GltfFile& file_;
    Scene& scene_;
    std::map<int, std::optional<Picture>> pictures_;      // by image
    std::map<std::tuple<int, int, bool>, int> textures_;  // by image, sampler, sRGB
};

/// The reference `key` to a texture in the JSON object of an extension.
tinygltf::TextureInfo texture_info(const tinygltf::Value& extension, const std::string& key);

TextureSlot no_texture();

}  // namespace lw
