// Irradiance at the lattice nodes, per lamp at unit power: geometry and lamps stand still and powers are weights, so a
// frame needs one look-up per pixel.
#pragma once
#include <vector>

#include "maps/final_gather.h"

namespace lw {

/// Irradiance of all nodes for lamp 0, then of all for lamp 1, ...
struct NodeIrradiance {
    std::vector<uint> records;  // RGB9E5 of lux per unit intensity x scale
    float scale = 1;            // so that the brightest fits
};

/// Reflected light by final gathering, and the direct light of lamps with a surface; that of other lamps is left to
/// shadow rays. `caustics`: photons whose light is gathered apart, but which rays see on surfaces.
NodeIrradiance gather_irradiance(const GatherInput& input, const PhotonGrids& caustics);

/// All light where photons hold the direct light too: their estimate, smoothed. `photons`: in the grids of the lattice.
NodeIrradiance smooth_irradiance(const Scene& scene, const Lattice& lattice, const PhotonRecords& photons);

}  // namespace lw
