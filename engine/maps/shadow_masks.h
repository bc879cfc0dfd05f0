// Where small lamps cast shadows on plane patches: a lamp is there or not, so 8 x 8 looks at it from a cell say most.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// A mask of each point, spot or directional lamp in each cell of a plane patch around which the nodes disagree
/// (`visible_lamps`, of find_visibility()), in the order of cells and lamps. None where what stands between tints the
/// light unevenly.
std::vector<ShadowMask> find_shadow_masks(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
                                          const std::vector<uint>& visible_lamps);

}  // namespace lw
