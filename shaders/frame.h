// The interface between the renderer and its shaders: bindings, specialization constants, push constants. Set 0 is the
// scene and its photon map (gather/resident), set 1 the picture.
#ifndef LW_FRAME_H
#define LW_FRAME_H
#include "bvh.h"
#include "followed.h"
#include "photon_map.h"
#include "scene.h"
#ifdef __cplusplus
namespace lw {
#endif

// Set 0. Arrays read at random are texel buffers, records whole texels: a software rasterizer fetches four words of a
// texel in the time of one word of a storage buffer. Corners are three per triangle, without indices.
LW_CONST uint binding_corners = 0u;    // RGBA32F twice: position and u, normal and v of the first texture coordinates
LW_CONST uint binding_triangles = 1u;  // RGBA32: map of the front, of the back, material, light or -1
LW_CONST uint binding_uv1 = 2u;        // RG32F per corner
LW_CONST uint binding_colors = 3u;     // RGBA32F per corner
LW_CONST uint binding_tangents = 4u;   // RGBA32F per corner
LW_CONST uint binding_texels = 5u;     // RGBA8
LW_CONST uint binding_grids = 6u;      // RGBA32, SurfaceGrid
LW_CONST uint binding_cell_starts = 7u;
LW_CONST uint binding_places = 8u;  // RG32, PhotonPlace
LW_CONST uint binding_fluxes = 9u;
LW_CONST uint binding_directions = 10u;
LW_CONST uint binding_coverage = 11u;
LW_CONST uint binding_cell_light = 12u;  // RGBA32
LW_CONST uint binding_cell_words = 13u;
LW_CONST uint binding_bvh_nodes = 14u;  // RGBA32, BvhNode
LW_CONST uint binding_bvh_triangles = 15u;
LW_CONST uint binding_materials = 16u;     // RGBA32, material_texels for each Material
LW_CONST uint binding_lamp_powers = 17u;   // RGBA32F, LampPower
LW_CONST uint binding_caustic_maps = 18u;  // RG32 per triangle: map of the front, of the back; empty without caustics
LW_CONST uint binding_shadow_masks = 19u;  // RGBA32
LW_CONST uint binding_textures = 20u;      // RGBA32, texture_texels for each
LW_CONST uint texel_binding_count = 21u;
LW_CONST uint binding_lights = 21u;  // from here on storage buffers
LW_CONST uint binding_emitters = 22u;
LW_CONST uint scene_binding_count = 23u;
LW_CONST uint binding_acceleration = 23u;  // where rays are traced by ray queries
LW_CONST uint material_texels = 16u;
LW_CONST uint texture_texels = 2u;

// Photon records beyond the device's texel buffers are split into chunks of 2^shift records, one descriptor each.
LW_CONST uint max_chunks = 4u;

LW_CONST uint binding_visibility = 0u;
LW_CONST uint binding_radiance = 1u;
LW_CONST uint binding_ray_lists = 2u;
LW_CONST uint binding_ray_pixels = 3u;
LW_CONST uint binding_screen = 4u;
LW_CONST uint binding_light = 5u;     // the radiance buffer as texels
LW_CONST uint binding_followed = 6u;  // Followed per pixel

LW_CONST uint constant_has_uv0 = 0u;
LW_CONST uint constant_has_uv1 = 1u;
LW_CONST uint constant_has_colors = 2u;
LW_CONST uint constant_has_tangents = 3u;
LW_CONST uint constant_has_textures = 4u;
LW_CONST uint constant_has_directions = 5u;
LW_CONST uint constant_has_alpha = 6u;
LW_CONST uint constant_has_transmission = 7u;
LW_CONST uint constant_chunks = 8u;
LW_CONST uint constant_chunk_shift = 9u;
LW_CONST uint constant_gather_mode = 10u;
LW_CONST uint constant_heap_size = 11u;
LW_CONST uint constant_has_direct = 12u;
LW_CONST uint constant_has_coverage = 13u;
LW_CONST uint constant_has_visible_lamps = 14u;
LW_CONST uint constant_has_mesh_lamps = 15u;
LW_CONST uint constant_has_emissive_textures = 16u;
LW_CONST uint constant_has_shadow_rays = 17u;
LW_CONST uint constant_has_metallic_roughness_textures = 18u;
LW_CONST uint constant_has_transmission_textures = 19u;
LW_CONST uint constant_has_followed = 20u;  // view paths go on from some surfaces
LW_CONST uint constant_stage = 21u;
LW_CONST uint constant_has_caustics = 22u;
LW_CONST uint constant_has_profiles = 23u;
LW_CONST uint constant_has_smooth_caustics = 24u;
LW_CONST uint constant_has_shadow_masks = 25u;
LW_CONST uint constant_looks_through =
    26u;  // glass and blends are surfaces of the view, what is behind them is followed
LW_CONST uint constant_followed_roughness = 27u;  // bits of a float: lobes of smoother surfaces are followed
LW_CONST uint constant_of_followed = 28u;         // photons and rays at the ends of followed paths
LW_CONST uint constant_first_cut = 29u;           // first of the cuts among the grids, no_map without any
LW_CONST uint constant_first_caustic_map = 30u;   // grids from here on are of caustics
LW_CONST uint constant_first_caustic_cut = 31u;
LW_CONST uint constant_first_see_through =
    32u;  // with ray queries: first of the triangles that may let light through, or no_map
LW_CONST uint constant_first_listed = 33u;  // where the triangles of a draw begin in the list (cull.h)
LW_CONST uint constant_pixel_margin = 34u;  // bits of a float: pixels by which a triangle may reach beyond its box
LW_CONST uint constant_count = 35u;

/// The dispatches of the gather: photons at all pixels, then rays at those that need any; where view paths go on, a
/// dispatch that follows them, and photons and rays at their ends.
LW_CONST uint stage_photons = 0u;
LW_CONST uint stage_rays = 1u;
LW_CONST uint stage_follow = 2u;
LW_CONST uint gather_group_side = 8u;  // pixels

/// The arguments of the dispatch for rays to a pair of lamps; its pixels are listed from pair * pixels of the picture
/// on. A dispatch for each pair: Mesa's software rasterizer ends all loops of an invocation after 65,535 rounds in sum,
/// without a word, and rays to many lamps get there.
struct RayPixels {
    uint groups_x;
    uint groups_y;
    uint groups_z;
    uint count;
};

/// Triangles drawn as one instance. Few, because a rasterizer on the CPU walks all vertices of an instance again and
/// again.
LW_CONST uint cluster_triangles = 64u;
LW_CONST uint no_triangle = 0xffffffffu;

/// What the user can dim and tint: photons of the light count `weight` (intensity x factor), its own glow `factor`. Two
/// texels.
struct LampPower {
    vec4 weight;  // RGB
    vec4 factor;  // RGB
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
    uint ray_pair;   // of lamps that rays are traced to
    uint following;  // pack_following()
};

/// Push constants of the tone mapping pass.
struct Screen {
    uint width;
    uint height;
    float exposure_ev;
};

#ifdef __cplusplus
static_assert(offsetof(Material, absorption) == 72 && offsetof(Material, base_color_texture) == 84);
static_assert(sizeof(Material) <= 16 * material_texels && sizeof(Texture) <= 16 * texture_texels);
static_assert(sizeof(LampPower) == 32 && sizeof(RayPixels) == 16 && sizeof(Screen) == 12);
static_assert(sizeof(Frame) == 124 && offsetof(Frame, following) == 120);
}  // namespace lw
#endif
#endif
