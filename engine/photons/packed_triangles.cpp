#include "photons/packed_triangles.h"

#include "base/parallel.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr float flat_normals = 0.9999995f;  // least cosine between shading and geometric normal: 1 mrad

/// True when the material is a Lambert reflector of one colour: most surfaces of most rooms.
bool is_plain_lambert(const Material& m) {
    return m.metallic <= 0 && m.specular <= 0 && m.transmission <= 0 && m.base_color_texture.texture < 0 &&
           m.normal_texture.texture < 0 && !(m.flags & material_unlit);
}

PackedTriangle packed_triangle_of(const Scene& scene, uint triangle) {
    const uvec3 c = scene.triangles[triangle];
    const Material& material = scene.material_of(triangle);
    PackedTriangle packed{};
    packed.corners = triangle_corners(scene, triangle);
    const vec3 product = triangle_product(scene, triangle);
    const float size = length(product);
    packed.normal = size > 0 ? product / size : vec3(0, 1, 0);
    packed.base_color = material.base_color;
    packed.is_matte = scene.colors.empty() && is_plain_lambert(material);
    const auto is_flat_at = [&](uint corner) { return dot(scene.normals[corner], packed.normal) > flat_normals; };
    packed.is_flat = is_flat_at(c.x) && is_flat_at(c.y) && is_flat_at(c.z);
    return packed;
}

}  // namespace

std::vector<PackedTriangle> pack_triangles(const Scene& scene) {
    std::vector<PackedTriangle> triangles(scene.triangles.size());
    parallel_for(
        triangles.size(), [&](size_t t) { triangles[t] = packed_triangle_of(scene, uint(t)); }, 1024);
    return triangles;
}

}  // namespace lw
