// Caustic light where it is smooth joins the lattice nodes, so that a frame gathers caustic photons only where they are dense.
#pragma once
#include "maps/lattice.h"

namespace lw {

/// Adds to map.irradiance what caustic photons bring to the nodes whose kernel of caustic_neighbours photons is no narrower
/// than 1.5 steps of their lattice, and marks them in map.smooth_caustics. Expects all grids, `nodes` of their lattices.
/// A map that leaves lamps to shadow rays only: cells without bits of lamps have no place for the marks.
void add_smooth_caustics(const Scene& scene, const std::vector<NodePoint>& nodes, PhotonMap& map);

}  // namespace lw
