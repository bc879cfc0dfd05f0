// The interface between the renderer and its shaders: records and push constants. Descriptors are in binding_table.h,
// specialization constants in frame_constants.h.
#ifndef LW_FRAME_H
#define LW_FRAME_H
#include "bindings.h"
#include "bvh.h"
#include "followed.h"
#include "photon_map.h"
#include "scene.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint material_texels = 16u;
LW_CONST uint texture_texels = 2u;

// Photon records beyond the device's texel buffers are split into chunks of 2^shift records, one descriptor each.
LW_CONST uint max_chunks = 4u;

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

/// What the user can dim and tint: photons of a lamp count `power` (intensity x factor), its own glow
/// counts `factor`. Two texels.
struct LampPower {
    vec4 power;   // RGB
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
