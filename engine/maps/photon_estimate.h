// The light that photons bring to the nodes of the lattices by the kernel estimate: noisy, and blurred by its
// bandwidth.
#pragma once
#include <vector>

#include "maps/lattice.h"

namespace lw {

/// Irradiance of each lamp at all nodes, lux for intensity 1, with the bandwidth of 300 photons: entry
/// lamp x nodes + node. `photons`: in the grids of the lattice.
std::vector<vec3> estimate_from_photons(const Scene& scene, const Lattice& lattice, const PhotonRecords& photons);

}  // namespace lw
