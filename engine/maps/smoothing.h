// Smooths the noise of estimates at the nodes of a lattice with a bilateral filter (Tomasi & Manduchi 1998). Each node
// is averaged with those around it that differ by no more than the noise explains; gradients and edges are kept.
#pragma once
#include <span>
#include <vector>

#include "maps/lattice.h"

namespace lw {

/// Planes of floats over a lattice, with a border of zeros as wide as the filter reaches.
class LatticePlanes {
  public:
    static constexpr uint border = 3;  // nodes

    LatticePlanes(uint across, uint along, uint count)
        : columns(across),
          rows(along),
          planes(count),
          stride_(columns + 2 * border),
          values_(size_t(stride_) * (rows + 2 * border) * planes, 0) {}

    /// Node (0, y) of a plane; y from -border to rows + border - 1.
    float* row(uint plane, int y) {
        return values_.data() + (size_t(plane) * (rows + 2 * border) + size_t(y + int(border))) * stride_ + border;
    }
    const float* row(uint plane, int y) const { return const_cast<LatticePlanes*>(this)->row(plane, y); }

    const uint columns, rows, planes;

  private:
    size_t stride_;
    std::vector<float> values_;
};

/// The relative noise of a node up to which others count: twice that of 300 photons, and what rays are smoothed by.
constexpr float noise_of_photons = 0.12f, noise_of_rays = 0.3f;

/// Smooths all planes of `light` with the same weights, which depend on `brightness` (one plane) and its relative
/// `noise`. Nodes whose `existence` (one plane) is 0 do not count.
LatticePlanes smooth(const LatticePlanes& light, const LatticePlanes& brightness, const LatticePlanes& existence,
                     float noise = noise_of_photons);

struct NodeSmoothing {
    float noise;         // relative, of a node
    bool leaves_buried;  // buried nodes do not count, and get no light
};

/// Smooths the light of one lamp at the nodes of grid m, by its own brightness. Nodes without a point do not count, and
/// get none. `light`: of all nodes.
void smooth_nodes(const Lattice& lattice, uint m, NodeSmoothing settings, std::span<vec3> light);

}  // namespace lw
