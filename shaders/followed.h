// Records of followed view paths (follow.glsl), shared by C++ and GLSL. A path starts at the surface that a pixel shows
// and goes on by reflection or transmission.
#ifndef LW_FOLLOWED_H
#define LW_FOLLOWED_H
#include "photon_map.h"
#ifdef __cplusplus
namespace lw {
#endif

/// Most surfaces that a path meets before it ends: mirrors, both sides of glass, holes.
LW_CONST uint max_followed_surfaces = 16u;
/// Where a path ends, another path goes on along the specular lobe when the lobe brings at least this part of what the
/// surface shows ...
LW_CONST float strong_lobe = 0.25f;
/// ... until this many lobes were followed one after another.
LW_CONST uint max_lobes = 4u;
/// At rough glass a path must end at times, to gather the light of small lamps that no ray can meet: least probability
/// of that, over the probability to go on.
LW_CONST float min_part_here = 0.5f;

/// The two ways to go on from the surface that a pixel shows. Each has its own list of pixels, after the lists for the
/// rays to lamps.
LW_CONST uint branch_reflected = 0u;
LW_CONST uint branch_through = 1u;
LW_CONST uint branch_count = 2u;
LW_INLINE uint pixel_lists(uint lamps, bool follows) { return ray_pairs(lamps) + (follows ? branch_count : 0u); }

/// Where the path of a pixel ended. Photons and rays are gathered there.
struct Followed {
    uint triangle;  // or no_triangle: the path ended nowhere
    vec2 barycentrics;
    vec3 eye;     // the point from which the last ray of the path came, m
    vec3 weight;  // of the light gathered there, RGB
    uint flags;
};
LW_CONST uint followed_leaves_lobe = 1u;  // estimates leave the specular lobe out: the path might have gone on along it
LW_CONST uint followed_goes_on = 2u;      // another path goes on along the lobe
LW_CONST uint followed_is_looked_at = 4u;  // the pixel reports the illuminance of this place

LW_CONST uint max_paths = 1024u;  // most paths of a pixel in one frame

/// Identifies one of the paths of a pixel.
struct Following {
    uint branch;
    uint depth;  // 0: starts at what the pixel shows; else where the path of the depth before ended
    uint path;   // one of `paths`
    uint paths;
};
LW_INLINE uint pack_following(Following f) { return f.branch | f.depth << 1 | f.path << 3 | f.paths << 17; }
LW_INLINE Following unpack_following(uint bits) {
    Following f;
    f.branch = bits & 1u;
    f.depth = (bits >> 1) & 3u;
    f.path = (bits >> 3) & 0x3fffu;
    f.paths = bits >> 17;
    return f;
}

#ifdef __cplusplus
static_assert(max_lobes <= 4 && max_paths < 1 << 14);
static_assert(sizeof(Followed) == 40 && offsetof(Followed, flags) == 36);
}  // namespace lw
#endif
#endif
