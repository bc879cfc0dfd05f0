// Adds caustics to the lattice nodes where they are smooth, so that a frame gathers caustic photons only where they are
// sharp.
#pragma once
#include "maps/irradiance.h"

namespace lw {

struct SmoothCaustics {
    NodeIrradiance irradiance;  // with the caustics of the marked nodes
    std::vector<uint> marks;    // a bit per node (PhotonMap::smooth_caustics)
};

/// Adds the light of the photons of `caustics` to the irradiance of find_irradiance(), at nodes where the kernel of
/// caustic_neighbours photons is no narrower than 1.5 lattice steps, and marks these nodes. Only for maps that leave
/// direct light to shadow rays: without bits of lamps cells have no word for the marks.
SmoothCaustics add_smooth_caustics(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics,
                                   NodeIrradiance irradiance);

}  // namespace lw
