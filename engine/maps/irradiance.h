// Irradiance at the lattice nodes, per lamp at unit power: geometry and lamps stand still and powers are weights, so a
// frame needs one look-up per pixel.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// Irradiance of all nodes for lamp 0, then lamp 1, ...: what the photons bring (default GatherSettings), and the
/// direct light of emissive meshes, whose shadows are soft, where photons do not hold it. That of point, spot and
/// directional lamps is left to shadow rays. RGB9E5 of lux per unit intensity x scale, which is chosen so that the
/// brightest fits.
std::vector<uint> find_irradiance(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                  const std::vector<NodePoint>& nodes, float& scale);

}  // namespace lw
