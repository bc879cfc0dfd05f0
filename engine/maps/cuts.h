// Walls on a patch: where other surfaces stand on a plane patch, it is cut along them, so that what lies on one side of
// a wall never counts on the other. Each piece is a patch of its own; a patch that nothing stands on stays whole.
#pragma once
#include "maps/patches.h"

namespace lw {

/// The piece of a plane patch inside an outline of its plane.
PatchShape piece_of(const PatchShape& whole, const std::vector<vec2>& outline);

/// Cuts the patches wider than their scale along all walls that stand on them (find_walls()). Appends the pieces, which
/// keep the scale; at most 255 cuts for one patch, and 48 of all cuts one after the other.
void cut_patches(const Scene& scene, ScaledPatches& scaled);

}  // namespace lw
