// Cuts plane patches along the walls that stand on them, so that photons on one side of a wall never count on the
// other. Each piece becomes a patch of its own; a patch on which nothing stands stays whole.
#pragma once
#include "maps/patches.h"

namespace lw {

/// Cuts the patches wider than the largest search `radius` (m) along all walls that stand on them (find_walls()).
/// Appends the pieces to `patches` and `shapes`; at most 255 cuts and 48 of them one after the other for one patch.
void cut_patches(const Scene& scene, float radius, Patches& patches, std::vector<PatchShape>& shapes);

}  // namespace lw
