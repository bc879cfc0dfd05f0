// Walls on a map: where other surfaces stand on a plane patch, it is cut along them, so that what lies on one side of a
// wall never counts on the other. Each piece is a patch of its own; a patch that nothing stands on stays whole.
#pragma once
#include "maps/patches.h"

namespace lw {

/// How far above a surface the walls that stand on it are looked for, m; thinner things lie on it. Light may pass
/// below.
inline float height_of_cuts(float radius) { return 0.03f * radius; }

/// Cuts the patches wider than the largest search `radius` (m) along all straight lines of at least that length along
/// which surfaces stand on them, at any angle steeper than 45 degrees. Appends the pieces to `patches` and `shapes`; at
/// most 255 cuts and 48 of them one after the other for one patch.
void cut_patches(const Scene& scene, float radius, Patches& patches, std::vector<PatchShape>& shapes);

/// The point of a convex outline nearest to `p`: itself when it lies inside.
vec2 nearest_in_outline(const std::vector<vec2>& outline, vec2 p);

}  // namespace lw
