// Adds caustics to the lattice nodes where they are smooth, so that a frame gathers caustic photons only where they are
// sharp.
#pragma once
#include "maps/irradiance.h"

namespace lw {

struct SmoothCaustics {
    NodeIrradiance irradiance;  // with the caustics of the marked nodes
    std::vector<uint> marks;    // a bit per node (PhotonMap::smooth_caustics)
};

/// Adds to the irradiance of gather_irradiance() what the photons of `caustics` bring to the nodes whose kernel of
/// caustic_neighbours photons is no narrower than 1.5 steps of their lattice, and marks those nodes. For maps that
/// leave lamps to shadow rays only: cells without bits of lamps have no place for the marks.
SmoothCaustics add_smooth_caustics(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics,
                                   NodeIrradiance irradiance);

/// What the photons of `caustics` bring to all nodes, lux of each lamp for intensity 1 (entry lamp x nodes + node),
/// blurred over at least 1.5 steps of the lattice: as rays see caustics on surfaces. Empty without caustics.
std::vector<vec3> estimate_caustics(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics);

}  // namespace lw
