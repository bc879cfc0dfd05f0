#include "scene/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lw {
namespace {

template <size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> variant_names(const GltfFile& file) {
    std::vector<std::string> names;
    const tinygltf::Value* root = extension_of(file.model.extensions, "KHR_materials_variants");
    if (!root || !root->Has("variants") || !root->Get("variants").IsArray()) return names;
    const tinygltf::Value& variants = root->Get("variants");
    for (size_t i = 0; i < variants.ArrayLen(); ++i) {
        const tinygltf::Value& entry = variants.Get(int(i));
        const bool named = entry.IsObject() && entry.Has("name") && entry.Get("name").IsString();
        names.push_back(named ? entry.Get("name").Get<std::string>() : "");
    }
    return names;
}

/// The material of a primitive in variant `index`, or the one it has.
int material_in_variant(const tinygltf::Primitive& primitive, int index) {
    const tinygltf::Value* own = extension_of(primitive.extensions, "KHR_materials_variants");
    if (!own || !own->Has("mappings") || !own->Get("mappings").IsArray()) return primitive.material;
    const tinygltf::Value& mappings = own->Get("mappings");
    for (size_t m = 0; m < mappings.ArrayLen(); ++m) {
        const tinygltf::Value& mapping = mappings.Get(int(m));
        if (!mapping.IsObject() || !mapping.Has("variants") || !mapping.Get("variants").IsArray()) continue;
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t v = 0; v < variants.ArrayLen(); ++v)
            if (variants.Get(int(v)).IsNumber() && int(variants.Get(int(v)).GetNumberAsDouble()) == index)
                return index_of(mapping, "material", primitive.material);
    }
    return primitive.material;
}

}  // namespace

bool reads_extension(const std::string& extension) {
    static constexpr std::array<std::string_view, 19> names = {"KHR_lights_punctual",
                                                               "KHR_materials_emissive_strength",
                                                               "KHR_materials_specular",
                                                               "KHR_materials_ior",
                                                               "KHR_materials_unlit",
                                                               "KHR_materials_transmission",
                                                               "KHR_materials_volume",
                                                               "KHR_materials_pbrSpecularGlossiness",
                                                               "KHR_materials_variants",
                                                               "KHR_texture_transform",
                                                               "KHR_texture_basisu",
                                                               "KHR_mesh_quantization",
                                                               "KHR_draco_mesh_compression",
                                                               "KHR_meshopt_compression",
                                                               "KHR_node_visibility",
                                                               "EXT_mesh_gpu_instancing",
                                                               "EXT_meshopt_compression",
                                                               "EXT_texture_webp",
                                                               "EXT_lights_ies"};
    return is_among(names, extension);
}

bool changes_look(const std::string& extension) {
    // Metadata, or things with their own message (images), or with a plain fallback in the file.
    static constexpr std::array<std::string_view, 4> silent = {"KHR_xmp", "KHR_xmp_json_ld", "EXT_texture_avif",
                                                               "MSFT_texture_dds"};
    return !reads_extension(extension) && !is_among(silent, extension);
}

bool may_change_geometry(const std::string& extension) {
    static constexpr std::array<std::string_view, 11> words = {"mesh",     "geometry", "primitive",  "buffer",
                                                               "accessor", "node",     "instanc",    "splat",
                                                               "voxel",    "point",    "compression"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return extension.find(word) != std::string::npos; });
}

void choose_variant(GltfFile& file, const std::string& variant) {
    const std::vector<std::string> names = variant_names(file);
    const auto found = std::find(names.begin(), names.end(), variant);
    if (found == names.end()) {
        std::string all;
        for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
        file.fail("has no variant \"" + variant + "\"; there are: " + (all.empty() ? "none" : all));
    }
    const int index = int(found - names.begin());
    for (tinygltf::Mesh& mesh : file.model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives)
            primitive.material = material_in_variant(primitive, index);
}

}  // namespace lw
