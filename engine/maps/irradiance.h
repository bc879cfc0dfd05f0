// Irradiance at the lattice nodes, per lamp at unit power: geometry and lamps stand still and powers are weights, so a
// frame needs one look-up per pixel.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// Irradiance of all nodes for lamp 0, then of all for lamp 1, ...
struct NodeIrradiance {
    std::vector<uint> records;  // RGB9E5 of lux per unit intensity x scale
    float scale = 1;            // chosen so that the brightest fits
};

/// The input of find_irradiance(), by reference.
struct IrradianceInput {
    const Scene& scene;
    const RayCaster& caster;
    const Lattice& lattice;
    const PhotonRecords& photons;            // in the grids of the lattice
    const std::vector<uint>& visible_lamps;  // of find_visibility(); empty where photons hold all light
};

/// The irradiance of all nodes: by photons, with a bandwidth for 300 photons, and the direct light of emissive meshes
/// when photons do not hold it. Direct light of point, spot and directional lamps is left to shadow rays.
NodeIrradiance find_irradiance(const IrradianceInput& input);

}  // namespace lw
