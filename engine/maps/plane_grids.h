// Which grids lie on plane patches: a lamp's light on them follows from the lattice alone.
#pragma once
#include <vector>

#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

class PlaneGrids {
  public:
    /// The grids have their lattices.
    PlaneGrids(const Scene& scene, const SurfaceGrids& surfaces);

    /// True when all triangles of the patch of grid m lie in one plane, to 2 % of the step of its lattice.
    bool is_plane(size_t m) const { return plane_[m] != 0; }
    /// True when, besides, direct light of small lamps looks the same from all sides, and shading normals are the
    /// plane's.
    bool is_matte_plane(size_t m) const { return plane_[m] != 0 && matte_[m] != 0; }
    /// Of the highest corner over the origin of the grid along its normal, m.
    float height(size_t m) const { return heights_[m]; }

  private:
    std::vector<char> plane_, matte_;
    std::vector<float> heights_;
};

/// The point of a plane patch `cells` steps from its lattice's first node.
vec3 point_on_lattice(const SurfaceGrid& grid, vec2 cells, float height);

}  // namespace lw
