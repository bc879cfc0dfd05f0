// Where small lamps cast shadows on plane maps: a lamp is there or not, so 8 x 8 looks at it from a cell say most.
#pragma once
#include <vector>

#include "maps/photon_map.h"
#include "trace/ray_caster.h"

namespace lw {

/// A mask of each point, spot or directional lamp in each cell of a plane map around which the nodes disagree
/// (map.visible_lamps), in the order of cells and lamps. None where what stands between tints the light unevenly.
std::vector<ShadowMask> find_shadow_masks(const Scene& scene, const RayCaster& caster, const PhotonMap& map);

}  // namespace lw
