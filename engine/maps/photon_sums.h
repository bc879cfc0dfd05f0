// The photons of one grid, unpacked, and their kernel sums at many points: what a bake evaluates at the lattice nodes.
// A row of cells is a run of arrays, so that the distance test fills whole vector registers.
#pragma once
#include <span>
#include <vector>

#include "maps/photon_map.h"

namespace lw {

class PhotonSums {
  public:
    /// Partial sums per lamp. Photons of one lamp often follow each other, and with one sum each addition would wait
    /// for the one before.
    static constexpr size_t sums_per_lamp = 4;

    /// Unpacks the photons of a grid, which must outlive the sums.
    PhotonSums(const PhotonRecords& records, const SurfaceGrid& grid);

    /// Adds the flux of the photons within `radius` m of a point (u, v, h of the grid), weighted by kernel_shape(),
    /// to the sums of each lamp; record flux, that is lm times the map's flux scale. The fourth component is unused.
    void add(vec3 local, float radius, std::span<vec4> sums) const;

  private:
    void weigh(size_t first, size_t count, vec3 local, float inverse_radius2, float* weights) const;
    void add_row(size_t first, size_t last, vec3 local, float inverse_radius2, std::span<vec4> sums) const;
    void add_run(size_t first, size_t last, vec3 local, float inverse_radius2, std::span<vec4> sums) const;

    const SurfaceGrid& grid_;
    const uint* starts_;  // of the grid's cells
    uint first_;          // reference of the first cell
    std::vector<float> u_, v_, h_;
    std::vector<vec4> fluxes_;
    std::vector<uint> lamps_;
};

}  // namespace lw
