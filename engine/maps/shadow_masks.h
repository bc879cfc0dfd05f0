// Shadow masks: where shadows of small lamps cross plane patches. A small lamp is either seen or not, so 8 x 8 rays per
// cell describe its shadow well.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// Finds a mask for each cell of a plane patch and each point, spot or directional lamp that only some of the nodes
/// around the cell see. Masks are in the order of cells, then lamps. There is none where the light is tinted unevenly
/// on its way. `visible_lamps`: of find_visibility().
std::vector<ShadowMask> find_shadow_masks(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
                                          const std::vector<uint>& visible_lamps);

}  // namespace lw
