#include "photons/facets.h"

#include "base/parallel.h"

namespace lw {
namespace {

constexpr float flat_normals = 0.9999995f;  // least cosine to the geometric normal: 1 mrad

/// True when the material is a Lambert reflector of one colour: most surfaces of most rooms.
bool is_plain_lambert(const Material& m) {
    return m.metallic <= 0 && m.specular <= 0 && m.transmission <= 0 && m.base_color_texture.texture < 0 &&
           m.normal_texture.texture < 0 && !(m.flags & material_unlit);
}

Facet facet_of(const Scene& scene, uint triangle) {
    const uvec3 c = scene.triangles[triangle];
    const Material& material = scene.material_of(triangle);
    Facet facet{};
    facet.corners = {scene.positions[c.x], scene.positions[c.y], scene.positions[c.z]};
    const vec3 product = cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
    const float size = length(product);
    facet.normal = size > 0 ? product / size : vec3(0, 1, 0);
    facet.base_color = material.base_color;
    facet.is_matte = scene.colors.empty() && is_plain_lambert(material);
    const auto is_flat_at = [&](uint corner) { return dot(scene.normals[corner], facet.normal) > flat_normals; };
    facet.is_flat = is_flat_at(c.x) && is_flat_at(c.y) && is_flat_at(c.z);
    return facet;
}

}  // namespace

std::vector<Facet> facets_of(const Scene& scene) {
    std::vector<Facet> facets(scene.triangles.size());
    parallel_for(
        facets.size(), [&](size_t t) { facets[t] = facet_of(scene, uint(t)); }, 1024);
    return facets;
}

}  // namespace lw
