#include "scene/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_textures.h"

namespace lw {
namespace {

vec3 vector_of(const tinygltf::Value& object, const std::string& key, vec3 otherwise) {
    if (!object.Has(key) || object.Get(key).ArrayLen() < 3) return otherwise;
    const tinygltf::Value& array = object.Get(key);
    return {float(array.Get(0).GetNumberAsDouble()), float(array.Get(1).GetNumberAsDouble()),
            float(array.Get(2).GetNumberAsDouble())};
}

constexpr float min_attenuation = 1e-6f;  // a black attenuationColor still has a finite logarithm

float unit(double value) { return float(std::clamp(value, 0.0, 1.0)); }

vec3 vector_of(const std::vector<double>& v, vec3 otherwise) {
    return v.size() >= 3 ? vec3(float(v[0]), float(v[1]), float(v[2])) : otherwise;
}

void read_base(const tinygltf::Material& source, Material& m) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    m.base_color = glm::clamp(vector_of(pbr.baseColorFactor, vec3(1)), 0.0f, 1.0f);
    m.alpha = pbr.baseColorFactor.size() == 4 ? unit(pbr.baseColorFactor[3]) : 1.0f;
    m.metallic = unit(pbr.metallicFactor);
    m.roughness = unit(pbr.roughnessFactor);
    m.emissive = vector_of(source.emissiveFactor, vec3(0));
    m.alpha_cutoff = float(source.alphaCutoff);
    m.normal_scale = float(source.normalTexture.scale);
    if (source.doubleSided) m.flags |= material_double_sided;
    if (source.alphaMode == "MASK") m.flags |= material_alpha_mask;
    if (source.alphaMode == "BLEND") m.flags |= material_alpha_blend;
}

void read_extensions(const tinygltf::Material& source, Material& m) {
    if (const auto* e = extension_of(source.extensions, "KHR_materials_emissive_strength"))
        m.emissive *= float(number_of(*e, "emissiveStrength", 1));
    if (const auto* e = extension_of(source.extensions, "KHR_materials_specular")) {
        m.specular = unit(number_of(*e, "specularFactor", 1));
        m.specular_color = glm::max(vector_of(*e, "specularColorFactor", vec3(1)), vec3(0));
    }
    if (const auto* e = extension_of(source.extensions, "KHR_materials_ior")) m.ior = float(number_of(*e, "ior", 1.5));
    if (const auto* e = extension_of(source.extensions, "KHR_materials_transmission"))
        m.transmission = unit(number_of(*e, "transmissionFactor", 0));
    if (m.ior == 0) m.transmission = 0;  // reflects everything (KHR_materials_ior)
    if (extension_of(source.extensions, "KHR_materials_unlit")) {
        m.flags |= material_unlit;
        m.emissive = vec3(0);
    }
}

/// KHR_materials_pbrSpecularGlossiness as a dielectric that reflects its specular colour at normal incidence: index of
/// refraction 0, as KHR_materials_ior has it for this conversion.
void read_specular_glossiness(GltfFile& file, TextureLoader& loader, const tinygltf::Material& source,
                              const std::string& where, Material& m) {
    const auto* e = extension_of(source.extensions, "KHR_materials_pbrSpecularGlossiness");
    if (!e) return;
    m.base_color = glm::clamp(vector_of(*e, "diffuseFactor", vec3(1)), 0.0f, 1.0f);
    m.alpha = e->Has("diffuseFactor") && e->Get("diffuseFactor").ArrayLen() == 4
                  ? unit(e->Get("diffuseFactor").Get(3).GetNumberAsDouble())
                  : 1.0f;
    const float glossiness = unit(number_of(*e, "glossinessFactor", 1));
    m.metallic = 0;
    m.roughness = 1 - glossiness;
    m.specular_color = glm::clamp(vector_of(*e, "specularFactor", vec3(1)), 0.0f, 1.0f);
    m.specular = m.specular_color == vec3(0) ? 0.0f : 1.0f;  // black: no lobe, at grazing angles neither
    m.ior = 0;
    m.base_color_texture = loader.slot(texture_info(*e, "diffuseTexture"), true, where + ": diffuseTexture");
    m.metallic_roughness_texture = no_texture();
    const tinygltf::TextureInfo reference = texture_info(*e, "specularGlossinessTexture");
    if (reference.index < 0) return;
    const GlossinessTexture texture = loader.glossiness(reference, glossiness, where + ": specularGlossinessTexture");
    if (texture.roughness.texture < 0) return;
    m.metallic_roughness_texture = texture.roughness;
    m.roughness = 1;
    m.specular_color *= texture.mean_specular;
    file.warn(where + ": the colours of the specularGlossinessTexture are replaced by their mean");
}

/// KHR_materials_volume: transmissive surfaces are thin sheets unless the material has a thickness; the light inside
/// falls as attenuationColor^(distance / attenuationDistance). The thickness itself is that of the mesh.
void read_volume(const GltfFile& file, const tinygltf::Material& source, const std::string& where, Material& m) {
    const auto* e = extension_of(source.extensions, "KHR_materials_volume");
    const double thickness = e ? number_of(*e, "thicknessFactor", 0) : 0;
    if (!std::isfinite(thickness) || thickness < 0) file.fail(where + ": thicknessFactor must not be negative");
    if (m.transmission > 0 && !(thickness > 0)) m.flags |= material_thin;
    if (!e || !(thickness > 0) || !e->Has("attenuationDistance")) return;
    const double distance = number_of(*e, "attenuationDistance", 1);
    if (!(distance > 0)) file.fail(where + ": attenuationDistance must be positive");
    const vec3 color = glm::clamp(vector_of(*e, "attenuationColor", vec3(1)), vec3(min_attenuation), vec3(1));
    m.absorption = -glm::log(color) / float(std::clamp(distance, 1e-9, 1e30));
}

void warn_about_ignored_textures(GltfFile& file, const tinygltf::Material& source, const std::string& where) {
    const auto* specular = extension_of(source.extensions, "KHR_materials_specular");
    if (specular && (specular->Has("specularTexture") || specular->Has("specularColorTexture")))
        file.warn(where + ": specular textures of KHR_materials_specular are ignored");
    const auto* volume = extension_of(source.extensions, "KHR_materials_volume");
    if (volume && volume->Has("thicknessTexture"))
        file.warn(where + ": the thicknessTexture is ignored, the thickness is that of the mesh");
}

void read_textures(TextureLoader& loader, const tinygltf::Material& source, const std::string& where, Material& m) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    m.base_color_texture = loader.slot(pbr.baseColorTexture, true, where + ": baseColorTexture");
    m.metallic_roughness_texture =
        loader.slot(pbr.metallicRoughnessTexture, false, where + ": metallicRoughnessTexture");
    tinygltf::TextureInfo normal;
    normal.index = source.normalTexture.index;
    normal.texCoord = source.normalTexture.texCoord;
    normal.extensions = source.normalTexture.extensions;
    m.normal_texture = loader.slot(normal, false, where + ": normalTexture");
    m.emissive_texture = loader.slot(source.emissiveTexture, true, where + ": emissiveTexture");
    if (const auto* e = extension_of(source.extensions, "KHR_materials_transmission"))
        m.transmission_texture =
            loader.slot(texture_info(*e, "transmissionTexture"), false, where + ": transmissionTexture");
}

/// Factors of the file are doubles: one beyond the floats would make light that is no number.
bool is_finite(const Material& m) {
    const vec3 c = m.specular_color;
    bool finite = std::isfinite(c.x + c.y + c.z) && std::isfinite(m.normal_scale);
    for (const TextureSlot& slot : {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture,
                                    m.emissive_texture, m.transmission_texture})
        finite = finite && std::isfinite(dot(slot.row0, slot.row0) + dot(slot.row1, slot.row1));
    return finite;
}

}  // namespace

Material default_material() {
    Material m{};
    m.base_color = vec3(1);
    m.alpha = 1;
    m.metallic = 1;
    m.roughness = 1;
    m.specular = 1;
    m.specular_color = vec3(1);
    m.ior = 1.5f;
    m.alpha_cutoff = 0.5f;
    m.normal_scale = 1;
    for (TextureSlot* slot : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                              &m.emissive_texture, &m.transmission_texture})
        *slot = no_texture();
    return m;
}

void load_materials(GltfFile& file, Scene& scene) {
    TextureLoader loader(file, scene);
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        const tinygltf::Material& source = file.model.materials[i];
        const std::string where = label("material", i, source.name);
        Material m = default_material();
        read_base(source, m);
        read_extensions(source, m);
        read_volume(file, source, where, m);
        read_textures(loader, source, where, m);
        read_specular_glossiness(file, loader, source, where, m);
        if (loader.is_black(m.emissive_texture)) m.emissive = vec3(0), m.emissive_texture = no_texture();  // no lamp
        warn_about_ignored_textures(file, source, where);
        if (!std::isfinite(m.ior) || (m.ior != 0 && m.ior < 1)) file.fail(where + ": ior must be 0 or at least 1");
        if (!std::isfinite(m.emissive.x + m.emissive.y + m.emissive.z))
            file.fail(where + ": the emission is not finite");
        if (m.emissive.x + m.emissive.y + m.emissive.z > max_strength)
            file.fail(where + ": the emission is larger than 1e15");
        if (!is_finite(m)) file.fail(where + ": a factor is not finite");
        scene.materials.push_back(m);
        scene.material_names.push_back(source.name.empty() ? "material_" + std::to_string(i) : source.name);
    }
}

VertexNeeds vertex_needs(const Scene& scene) {
    VertexNeeds needs;
    for (const Material& m : scene.materials) {
        for (const TextureSlot& slot : {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture,
                                        m.emissive_texture, m.transmission_texture}) {
            if (slot.texture < 0) continue;
            (slot.texcoord == 0 ? needs.uv0 : needs.uv1) = true;
        }
        needs.tangents |= m.normal_texture.texture >= 0;
    }
    return needs;
}

}  // namespace lw
