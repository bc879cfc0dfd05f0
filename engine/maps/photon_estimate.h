// The light that photons bring to the nodes of the lattices by the kernel estimate: noisy, and blurred by its
// bandwidth.
#pragma once
#include <vector>

#include "maps/grid_reader.h"
#include "maps/lattice.h"

namespace lw {

/// The bandwidth at a node at `local` in the frame of its grid, m: that of 300 photons, but at least 0.75 steps of the
/// lattice. Narrower kernels leave gaps between nodes, and the top of a bright spot would stand for all around it.
float bandwidth_at_node(const GridReader& reader, const SurfaceGrid& grid, vec3 local);

/// Irradiance of each lamp at all nodes, lux for intensity 1, with the bandwidth at each: entry lamp x nodes + node.
/// `photons`: in the grids of the lattice.
std::vector<vec3> estimate_from_photons(const Scene& scene, const Lattice& lattice, const PhotonRecords& photons);

}  // namespace lw
