// The text of the gather over readers that count: what a pixel reads and tests, on any device.
#pragma once
#include "maps/estimate.h"

namespace lw {

/// Records read, by kind.
struct Reads {
    uint64_t surfaces = 0, grids = 0, cells = 0, photons = 0, photon_light = 0, directions = 0, nodes = 0,
             triangles = 0, words = 0;

    /// As they lie on the device: 96 bytes for the corners of a triangle, 36 for their positions alone.
    double bytes() const {
        return double(surfaces) * (96 + sizeof(Material)) + double(grids) * sizeof(SurfaceGrid) +
               double(cells) * sizeof(uvec4) + double(photons) * sizeof(PhotonPlace) +
               4 * double(photon_light + words) + 2 * double(directions) + double(nodes) * sizeof(BvhNode) +
               40 * double(triangles);
    }
};

class CountingEstimator : public PhotonEstimator {
  public:
    using PhotonEstimator::PhotonEstimator;

    Surface surface_at(uint triangle, vec2 barycentrics) const {
        return ++reads.surfaces, PhotonEstimator::surface_at(triangle, barycentrics);
    }
    const SurfaceGrid& grid_at(uint index) const { return ++reads.grids, PhotonEstimator::grid_at(index); }
    PhotonPlace photon_place(uint i) const { return ++reads.photons, PhotonEstimator::photon_place(i); }
    uint photon_flux(uint i) const { return ++reads.photon_light, PhotonEstimator::photon_flux(i); }
    uint photon_direction(uint i) const { return ++reads.directions, PhotonEstimator::photon_direction(i); }
    uvec4 cell_light(uint cell) const { return ++reads.cells, PhotonEstimator::cell_light(cell); }
    uvec4 shadow_mask(uint i) const { return ++reads.cells, PhotonEstimator::shadow_mask(i); }
    uint cell_word(uint word) const { return ++reads.words, PhotonEstimator::cell_word(word); }
    uint cell_start(uint cell) const { return ++reads.words, PhotonEstimator::cell_start(cell); }
    uint node_coverage(uint node) const { return ++reads.words, PhotonEstimator::node_coverage(node); }
    uint grid_of(uint triangle, bool front) const { return ++reads.words, PhotonEstimator::grid_of(triangle, front); }
    uint caustic_grid_of(uint triangle, bool front) const {
        return ++reads.words, PhotonEstimator::caustic_grid_of(triangle, front);
    }
    const BvhNode& bvh_node_at(uint i) const { return ++reads.nodes, PhotonEstimator::bvh_node_at(i); }
    uint bvh_triangle_at(uint i) const { return ++reads.triangles, PhotonEstimator::bvh_triangle_at(i); }

#include "shaders/gather.glsl"
#include "shaders/rays.glsl"

#include "shaders/caustics.glsl"
#include "shaders/direct.glsl"

#include "shaders/shade.glsl"

#include "shaders/follow.glsl"

    mutable Reads reads;
};

}  // namespace lw
