// The surface at (triangle, barycentrics) on the CPU: the text of shaders/surface.glsl and bsdf.glsl over a Scene.
#pragma once
#include "scene/scene.h"

namespace lw {

/// Read-only view of a Scene with the functions of shaders/surface.glsl and shaders/bsdf.glsl as members:
/// surface_at(triangle, barycentrics), eval_brdf(surface, n, to_view, to_light, diffuse_only). The scene must outlive
/// it.
class SurfaceReader {
  public:
    explicit SurfaceReader(const Scene& scene)
        : positions(scene.positions.data()),
          normals(scene.normals.data()),
          uv0(scene.uv0.data()),
          uv1(scene.uv1.data()),
          colors(scene.colors.data()),
          tangents(scene.tangents.data()),
          triangles(scene.triangles.data()),
          triangle_objects(scene.triangle_objects.data()),
          objects(scene.objects.data()),
          materials(scene.materials.data()),
          textures(scene.textures.data()),
          texels(scene.texels.data()),
          has_uv0(!scene.uv0.empty()),
          has_uv1(!scene.uv1.empty()),
          has_colors(!scene.colors.empty()),
          has_tangents(!scene.tangents.empty()),
          has_textures(!scene.textures.empty()) {}

    vec3 corner_position(uint triangle, uint c) const { return positions[triangles[triangle][int(c)]]; }
    vec3 corner_normal(uint triangle, uint c) const { return normals[triangles[triangle][int(c)]]; }
    vec2 corner_uv0(uint triangle, uint c) const { return uv0[triangles[triangle][int(c)]]; }
    vec2 corner_uv1(uint triangle, uint c) const { return uv1[triangles[triangle][int(c)]]; }
    vec4 corner_color(uint triangle, uint c) const { return colors[triangles[triangle][int(c)]]; }
    vec4 corner_tangent(uint triangle, uint c) const { return tangents[triangles[triangle][int(c)]]; }
    const Texture& texture_at(int i) const { return textures[i]; }
    const Material& material_of(uint triangle) const { return materials[objects[triangle_objects[triangle]].material]; }
    int light_of_surface(uint triangle) const { return objects[triangle_objects[triangle]].light; }
    uint texel_word(uint i) const { return texels[i]; }
    vec4 texel_at(uint i) const {
        const uint bits = texels[i];
        return vec4(uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u) / 255.0f;
    }

#include "shaders/bsdf.glsl"
#include "shaders/profile.glsl"
#include "shaders/surface.glsl"

  protected:
    static constexpr bool has_alpha = true;  // the CPU asks the material
    static constexpr bool has_transmission = true;
    static constexpr bool has_metallic_roughness_textures = true, has_emissive_textures = true,
                          has_transmission_textures = true;

    const vec3* positions;
    const vec3* normals;
    const vec2* uv0;
    const vec2* uv1;
    const vec4* colors;
    const vec4* tangents;
    const uvec3* triangles;
    const uint* triangle_objects;
    const Object* objects;
    const Material* materials;
    const Texture* textures;
    const uint* texels;
    bool has_uv0, has_uv1, has_colors, has_tangents, has_textures;
};

}  // namespace lw
