#include "scene/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lw {

bool reads_extension(const std::string& extension) {
    static constexpr std::array<std::string_view, 11> names = {
        "KHR_lights_punctual",   "KHR_materials_emissive_strength", "KHR_materials_specular", "KHR_materials_ior",
        "KHR_materials_unlit",   "KHR_materials_transmission",      "KHR_materials_volume",   "KHR_texture_transform",
        "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",         "EXT_lights_ies"};
    return std::find(names.begin(), names.end(), extension) != names.end();
}

bool changes_look(const std::string& extension) {
    // Metadata, or things with their own message (images), or with a plain fallback in the file.
    static constexpr std::array<std::string_view, 9> silent = {"KHR_xmp",
                                                               "KHR_xmp_json_ld",
                                                               "KHR_materials_variants",
                                                               "KHR_texture_basisu",
                                                               "EXT_texture_webp",
                                                               "EXT_texture_avif",
                                                               "MSFT_texture_dds",
                                                               "EXT_meshopt_compression",
                                                               "KHR_draco_mesh_compression"};
    return !reads_extension(extension) && std::find(silent.begin(), silent.end(), extension) == silent.end();
}

}  // namespace lw
