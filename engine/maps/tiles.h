// Tiles of large triangles, such as a lawn or the slab of a storey: small where something stands on them, wide
// elsewhere, each with a scale of its own.
#pragma once
#include "maps/patches.h"
#include "trace/ray_caster.h"

namespace lw {

/// Cuts each patch of one triangle that is wider than 6 distances of its surroundings in the middle of its longer side,
/// and again its parts, as long as other surfaces are near. Appends the pieces to `scaled`.
void cut_into_tiles(const Scene& scene, const RayCaster& caster, ScaledPatches& scaled);

}  // namespace lw
