// Tells which grids belong to plane patches. There a point follows from its place on the lattice alone, and so does the
// light of a lamp.
#pragma once
#include <vector>

#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

class PlaneGrids {
  public:
    /// The lattices of the grids must be laid.
    PlaneGrids(const Scene& scene, const SurfaceGrids& surfaces);

    /// True when all triangles of the patch of grid m lie in one plane, to 2 % of the step of its lattice.
    bool is_plane(size_t m) const { return plane_[m] != 0; }
    /// True when, in addition, direct light of small lamps looks the same from all directions and shading normals are
    /// the plane's.
    bool is_matte_plane(size_t m) const { return plane_[m] != 0 && matte_[m] != 0; }
    /// The height of the patch's highest corner over the grid's origin, along its normal, m.
    float height(size_t m) const { return heights_[m]; }

  private:
    std::vector<char> plane_, matte_;
    std::vector<float> heights_;
};

/// The point of a plane patch that lies `cells` lattice steps, along u and v, from the first node. `height`: that of
/// PlaneGrids, m.
vec3 point_on_lattice(const SurfaceGrid& grid, vec2 cells, float height);

}  // namespace lw
