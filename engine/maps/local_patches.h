// Patches whose sizes follow the surroundings: small where something is near, wide where nothing is. What lies behind
// walls or far away changes none of them.
#pragma once
#include "maps/patches.h"
#include "trace/ray_caster.h"

namespace lw {

/// Groups triangle sides by (object, normal bin, cell), from cells of 16 m on: while a group is wider than 12 scales,
/// its cell is divided by eight. A triangle wider than its cell is a patch of its own.
ScaledPatches find_local_patches(const Scene& scene, const RayCaster& caster);

}  // namespace lw
