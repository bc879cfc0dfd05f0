// Look-ups in a photon map on the CPU: the patch of a point, the photons around it, the coverage of a kernel there. The
// text of shaders/map_lookup.glsl over a PhotonMap.
#pragma once
#include "maps/gather_settings.h"
#include "maps/grid_reader.h"

namespace lw {

/// Read-only view of a PhotonMap with the functions of shaders/map_lookup.glsl as members: place_on_grid(index,
/// position), bandwidth_from_counts(grid, local), caustic_radius(grid, local), covered_part(place, radius). The map
/// must outlive it.
class MapReader {
  public:
    /// `neighbours_wanted`: photons that the disc of bandwidth_from_counts() should hold.
    explicit MapReader(const PhotonMap& map, uint neighbours_wanted = GatherSettings{}.neighbours)
        : neighbours(neighbours_wanted), has_coverage(map.has_coverage()), map_(map) {}

    /// The grid or cut of a side of a triangle, or no_grid. caustic_grid_of(): that of its caustics, only for maps with
    /// caustics.
    uint grid_of(uint triangle, bool front) const { return map_.grid_of_side[2 * size_t(triangle) + (front ? 0 : 1)]; }
    uint caustic_grid_of(uint triangle, bool front) const {
        return map_.caustic_grid_of(2 * size_t(triangle) + (front ? 0 : 1));
    }
    /// The grid of this index; an empty one for no_grid.
    const SurfaceGrid& grid_at(uint index) const { return index < map_.grids.size() ? map_.grids[index] : empty_grid; }
    const Cut& cut_at(uint i) const { return map_.cuts[i]; }
    uint cell_start(uint cell) const { return map_.cell_starts[cell]; }
    uint node_coverage(uint node) const { return map_.coverage[node]; }

#include "shaders/map_lookup.glsl"

    /// Calls visit(reference, place, squared distance) for the photons of a grid that lie within `radius` m of a point
    /// on the same surface. `local`: the point in the frame of the grid.
    template <class Visit>
    void visit_photons(const SurfaceGrid& grid, vec3 local, float radius, const Visit& visit) const {
        GridReader{map_, map_.settings.radius}.visit_photons(grid, local, radius, visit);
    }

  private:
    static constexpr SurfaceGrid empty_grid{};
    uint neighbours;
    bool has_coverage;
    const PhotonMap& map_;
};

}  // namespace lw
