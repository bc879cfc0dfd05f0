#include "gather/constants.h"

#include <algorithm>
#include <bit>

namespace lw {
namespace {

uint32_t bits_of(bool value) { return value; }
uint32_t bits_of(uint value) { return value; }
uint32_t bits_of(float value) { return std::bit_cast<uint32_t>(value); }

bool any_material(const Scene& scene, uint flags) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& m) { return (m.flags & flags) != 0; });
}

bool any_texture(const Scene& scene, TextureSlot Material::*slot) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [=](const Material& m) { return (m.*slot).texture >= 0; });
}

void add_scene(const Scene& scene, FrameConstants& c) {
    c.has_uv0 = !scene.uv0.empty();
    c.has_uv1 = !scene.uv1.empty();
    c.has_colors = !scene.colors.empty();
    c.has_tangents = !scene.tangents.empty();
    c.has_textures = !scene.textures.empty();
    c.has_metallic_roughness_textures = any_texture(scene, &Material::metallic_roughness_texture);
    c.has_emissive_textures = any_texture(scene, &Material::emissive_texture);
    c.has_transmission_textures = any_texture(scene, &Material::transmission_texture);
    c.has_alpha = any_material(scene, material_alpha_mask | material_alpha_blend);
    c.has_transmission = std::any_of(scene.materials.begin(), scene.materials.end(),
                                     [](const Material& m) { return m.transmission > 0; });
    c.has_area_lamps =
        std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) { return !is_delta(light.type); });
    c.has_profiles =
        std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) { return has_table(light.type); });
}

void add_map(const PhotonMap& map, FrameConstants& c) {
    c.has_directions = map.has_directions();
    c.has_coverage = map.has_coverage();
    c.has_visible_lamps = map.has_visible_lamps();
    c.has_shadow_masks = !map.shadow_masks.empty();
    c.has_caustics = map.caustic_grids > 0;
    c.has_smooth_caustics = !map.smooth_caustics.empty();
}

}  // namespace

FrameConstants constants_of(const Scene& scene, const PhotonMap& map, bool traces_rays) {
    FrameConstants c;
    add_scene(scene, c);
    add_map(map, c);
    c.has_direct = traces_rays && !map.settings.direct_in_photons;
    c.follows_through = traces_rays && (c.has_transmission || any_material(scene, material_alpha_blend));
    return c;
}

#define LW_CONSTANT(type, name, value) {__LINE__, bits_of(constants.name)},

std::vector<SpecConstant> spec_constants_of(const FrameConstants& constants) {
    return {
#include "shaders/frame_constants.h"
    };
}

std::vector<SpecConstant> spec_constants_of(const ViewConstants& constants) {
    return {
#include "shaders/view_constants.h"
    };
}

}  // namespace lw
