// Walls on a map: where other surfaces stand on a plane patch, it is cut along them, so that what lies on one side of a
// wall never counts on the other. Each piece is a patch of its own; a patch that nothing stands on stays whole.
#pragma once
#include "maps/patches.h"

namespace lw {

/// How far above a surface the walls that stand on it are looked for, m; thinner things lie on it. Light may pass
/// below.
inline float height_of_cuts(float radius) { return 0.03f * radius; }

/// Cuts the patches wider than the largest search `radius` (m) along all walls that stand on them (find_walls()).
/// Appends the pieces to `patches` and `shapes`; at most 255 cuts and 48 of them one after the other for one patch.
void cut_patches(const Scene& scene, float radius, Patches& patches, std::vector<PatchShape>& shapes);

/// The point of a convex outline nearest to `p`: itself when it lies inside.
vec2 nearest_in_outline(const std::vector<vec2>& outline, vec2 p);

/// `p` moved inwards from every side of a convex outline that is closer than `distance`.
vec2 inside_outline(const std::vector<vec2>& outline, vec2 p, float distance);

}  // namespace lw
