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

// Photon records that do not fit into one texel buffer of the device are split into chunks of 2^chunk_shift records,
// with one descriptor each.
LW_CONST uint max_chunks = 4u;

/// The kinds of dispatch of the gather: photons at all pixels; rays to lamps at those pixels that need any; and
/// following of view paths, after which photons and rays are dispatched again for the ends of the paths.
LW_CONST uint stage_photons = 0u;
LW_CONST uint stage_rays = 1u;
LW_CONST uint stage_follow = 2u;
LW_CONST uint gather_group_side = 8u;  // pixels

/// A list of pixels: the arguments of its indirect dispatch, and how many pixels it has. The pixels of list i start at
/// entry i * (pixels of the picture). There is a list for each pair of lamps, because Mesa's software rasterizer
/// silently ends all loops of an invocation after 65,535 rounds in total, which rays to many lamps would reach.
struct RayPixels {
    uint groups_x;
    uint groups_y;
    uint groups_z;
    uint count;
};

/// Number of triangles drawn as one instance. It is small, because a software rasterizer walks all vertices of an
/// instance several times.
LW_CONST uint cluster_triangles = 64u;

/// The present power of a lamp: its photons are multiplied by `power`, the glow of its surface by `factor`. Two
/// texels.
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
    vec2 projection;  // clip coordinates = view.xy * projection / -view.z
    vec2 jitter;      // clip units
    float near;       // m
    uint width;
    uint height;
    uint neighbours;
    float inverse_flux_scale;
    uint triangle_limit;  // number of triangles
    uint sample_index;    // sample 0 overwrites the picture, others add to it
    float sample_weight;  // 1 / samples
    float ray_epsilon;    // m, how far above their surface rays start
    float scene_size;     // m, the diagonal of the bounds: no ray needs to go farther
    uint shadow_rays;     // per emissive mesh
    float inverse_irradiance_scale;
    uint ray_pair;   // the pair of lamps of this dispatch for rays
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
static_assert(sizeof(Frame) == 120 && offsetof(Frame, following) == 116);
}  // namespace lw
#endif
#endif
