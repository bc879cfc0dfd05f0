// Caustic light where it is smooth joins the lattice nodes, so that a frame gathers caustic photons only where they are
// dense.
#pragma once
#include "maps/lattice.h"

namespace lw {

/// Adds to the irradiance of find_irradiance() what caustic photons bring to the nodes whose kernel of
/// caustic_neighbours photons is no narrower than 1.5 steps of their lattice; returns a bit for each node, set for
/// those (PhotonMap::smooth_caustics). Expects all grids, `nodes` of their lattices. A map that leaves lamps to shadow
/// rays only: cells without bits of lamps have no place for the marks.
std::vector<uint> add_smooth_caustics(const Scene& scene, const std::vector<NodePoint>& nodes, const PhotonMap& map,
                                      std::vector<uint>& irradiance);

}  // namespace lw
