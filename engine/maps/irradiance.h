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

/// Where photons do not hold the direct light: reflected light by final gathering, and the direct light of lamps with a
/// surface; that of other lamps is left to shadow rays. `caustics`: photons whose light is gathered apart, but which
/// rays see on surfaces. Where photons hold all light (no visible_lamps in `input`): their estimate, smoothed.
NodeIrradiance find_irradiance(const GatherInput& input, const PhotonGrids& caustics);

}  // namespace lw
