// Records of view paths that go on from what the eye sees (follow.glsl), shared by C++ and GLSL.
#ifndef LW_FOLLOWED_H
#define LW_FOLLOWED_H
#include "photon_map.h"
#ifdef __cplusplus
namespace lw {
#endif

/// Surfaces that a followed view path meets at most: mirrors, both sides of glass, holes.
LW_CONST uint max_followed_surfaces = 16u;
/// A lobe that brings so much of what a surface shows is worth a path of its own where a path ends ...
LW_CONST float strong_lobe = 0.25f;
/// ... until so many lobes were followed one after another.
LW_CONST uint max_lobes = 4u;
/// At rough glass, how often a path ends to gather the light of small lamps, beside how often it goes on.
LW_CONST float min_part_here = 0.5f;

/// The ways on from a surface, each with its own list of pixels behind those of the rays.
LW_CONST uint branch_reflected = 0u;
LW_CONST uint branch_through = 1u;
LW_CONST uint branch_count = 2u;
LW_INLINE uint pixel_lists(uint lamps, bool follows) { return ray_pairs(lamps) + (follows ? branch_count : 0u); }

/// Where the view path of a pixel ended, for photons and rays to be gathered there.
struct Followed {
    uint triangle;  // or no_map: nowhere
    vec2 barycentrics;
    vec3 eye;     // where the last part of the path came from
    vec3 weight;  // of what is gathered
    uint flags;
};
LW_CONST uint followed_leaves_lobe = 1u;  // the specular lobe is not gathered: the path might have gone on along it
LW_CONST uint followed_goes_on = 2u;      // another path goes on along the lobe
LW_CONST uint followed_gives_illuminance = 4u;  // the pixel's illuminance is of this place

LW_CONST uint max_paths = 1024u;  // of a pixel, in one frame

/// Which of the paths of a pixel is followed.
struct Following {
    uint branch;
    uint depth;  // 0: from what the pixel sees; else from where the path of the depth before ended
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
