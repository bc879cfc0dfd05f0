// The interface between the renderer and its shaders: bindings, specialization constants, push constants and,
// for GLSL, the arrays themselves. Set 0 is the scene and its photon map (gather/resident), set 1 the picture.
#ifndef LW_FRAME_H
#define LW_FRAME_H
#include "bvh.h"
#include "photon_map.h"
#include "scene.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint binding_positions = 0u;
LW_CONST uint binding_normals = 1u;
LW_CONST uint binding_uv0 = 2u;
LW_CONST uint binding_uv1 = 3u;
LW_CONST uint binding_colors = 4u;
LW_CONST uint binding_tangents = 5u;
LW_CONST uint binding_triangles = 6u;
LW_CONST uint binding_triangle_objects = 7u;
LW_CONST uint binding_objects = 8u;
LW_CONST uint binding_materials = 9u;
LW_CONST uint binding_textures = 10u;
LW_CONST uint binding_texels = 11u;
LW_CONST uint binding_lamps = 12u;
LW_CONST uint binding_triangle_maps = 13u;
LW_CONST uint binding_grids = 14u;
LW_CONST uint binding_cell_starts = 15u;
LW_CONST uint binding_places = 16u;
LW_CONST uint binding_fluxes = 17u;
LW_CONST uint binding_directions = 18u;
LW_CONST uint binding_bvh_nodes = 19u;
LW_CONST uint binding_bvh_triangles = 20u;
LW_CONST uint binding_nodes = 21u;
LW_CONST uint binding_emitters = 22u;
LW_CONST uint binding_visible_lamps = 23u;
LW_CONST uint scene_binding_count = 24u;

// Photon records larger than maxStorageBufferRange are split into chunks of 2^shift records, one descriptor each.
// 29 storage buffers here and 3 in set 1 stay within lavapipe's 32 per stage: 2^24 x 4 references with its 128 MiB.
LW_CONST uint most_place_chunks = 4u;
LW_CONST uint most_flux_chunks = 2u;

LW_CONST uint binding_visibility = 0u;
LW_CONST uint binding_radiance = 1u;
LW_CONST uint binding_normal_depth = 2u;
LW_CONST uint binding_screen = 3u;

LW_CONST uint constant_has_uv0 = 0u;
LW_CONST uint constant_has_uv1 = 1u;
LW_CONST uint constant_has_colors = 2u;
LW_CONST uint constant_has_tangents = 3u;
LW_CONST uint constant_has_textures = 4u;
LW_CONST uint constant_has_directions = 5u;
LW_CONST uint constant_has_alpha = 6u;
LW_CONST uint constant_has_transmission = 7u;
LW_CONST uint constant_place_chunks = 8u;
LW_CONST uint constant_place_shift = 9u;
LW_CONST uint constant_flux_chunks = 10u;
LW_CONST uint constant_flux_shift = 11u;
LW_CONST uint constant_gather_mode = 12u;
LW_CONST uint constant_heap_size = 13u;
LW_CONST uint constant_has_direct = 14u;
LW_CONST uint constant_has_coverage = 15u;
LW_CONST uint constant_has_visible_lamps = 16u;
LW_CONST uint constant_has_mesh_lamps = 17u;
LW_CONST uint constant_has_emissive_textures = 18u;
LW_CONST uint constant_has_shadow_rays = 19u;
LW_CONST uint constant_has_metallic_roughness_textures = 20u;
LW_CONST uint constant_has_transmission_textures = 21u;
LW_CONST uint constant_has_mirrors = 22u;
LW_CONST uint constant_count = 23u;

/// Triangles drawn as one instance. Few, because a rasterizer on the CPU walks all vertices of an instance again and again.
LW_CONST uint cluster_triangles = 64u;
LW_CONST uint no_triangle = 0xffffffffu;

/// What the user can dim and tint: photons of the light count `weight` (intensity x factor), its own glow `factor`.
struct Lamp {
    Light light;
    vec3 weight;
    vec3 factor;
};

/// Push constants of visibility and gather: one view of the scene and how to estimate light in it.
struct Frame {
    vec3 camera_position;
    vec3 camera_right;
    vec3 camera_up;
    vec3 camera_back;
    vec2 projection;  // clip = view.xy * projection, divided by -view.z
    vec2 jitter;      // clip units
    float near;       // m
    uint width;
    uint height;
    uint neighbours;
    float max_radius;  // m
    float inverse_flux_scale;
    uint triangle_limit;  // number of triangles
    uint sample_index;    // 0 overwrites the picture, others add to it
    float sample_weight;  // 1 / samples
    float ray_epsilon;    // m, what shadow rays start above their surface
    float scene_size;     // m, beyond which nothing stands
    uint shadow_rays;     // per emissive mesh
    float inverse_irradiance_scale;
};

/// Push constants of the tone mapping pass.
struct Screen {
    uint width;
    uint height;
    float exposure_ev;
};

#ifdef __cplusplus
static_assert(sizeof(Lamp) == 84 && sizeof(Screen) == 12);
static_assert(sizeof(Frame) == 116 && offsetof(Frame, inverse_irradiance_scale) == 112);
}  // namespace lw
#else

layout(constant_id = constant_has_uv0) const bool has_uv0 = true;
layout(constant_id = constant_has_uv1) const bool has_uv1 = true;
layout(constant_id = constant_has_colors) const bool has_colors = true;
layout(constant_id = constant_has_tangents) const bool has_tangents = true;
layout(constant_id = constant_has_textures) const bool has_textures = true;
layout(constant_id = constant_has_directions) const bool has_directions = true;
layout(constant_id = constant_has_alpha) const bool has_alpha = true;
layout(constant_id = constant_has_transmission) const bool has_transmission = true;
layout(constant_id = constant_place_chunks) const uint place_chunks = 1u;
layout(constant_id = constant_place_shift) const uint place_shift = 24u;
layout(constant_id = constant_flux_chunks) const uint flux_chunks = 1u;
layout(constant_id = constant_flux_shift) const uint flux_shift = 25u;
layout(constant_id = constant_gather_mode) const uint gather_mode = 1u;
layout(constant_id = constant_heap_size) const uint heap_size = 256u;
layout(constant_id = constant_has_direct) const bool has_direct = true;
layout(constant_id = constant_has_coverage) const bool has_coverage = true;
layout(constant_id = constant_has_visible_lamps) const bool has_visible_lamps = true;
layout(constant_id = constant_has_mirrors) const bool has_mirrors = true;
layout(constant_id = constant_has_mesh_lamps) const bool has_mesh_lamps = true;
layout(constant_id = constant_has_metallic_roughness_textures) const bool has_metallic_roughness_textures = true;
layout(constant_id = constant_has_transmission_textures) const bool has_transmission_textures = true;
layout(constant_id = constant_has_emissive_textures) const bool has_emissive_textures = true;
layout(constant_id = constant_has_shadow_rays) const bool has_shadow_rays = true;

#define LW_ARRAY(TYPE, NAME) \
    layout(set = 0, binding = binding_##NAME, scalar) readonly buffer NAME##_buffer { TYPE NAME[]; }
LW_ARRAY(vec3, positions);
LW_ARRAY(vec3, normals);
LW_ARRAY(vec2, uv0);
LW_ARRAY(vec2, uv1);
LW_ARRAY(vec4, colors);
LW_ARRAY(vec4, tangents);
LW_ARRAY(uvec3, triangles);
LW_ARRAY(uint, triangle_objects);
LW_ARRAY(Object, objects);
LW_ARRAY(Material, materials);
LW_ARRAY(Texture, textures);
LW_ARRAY(uint, texels);
#endif
#endif
