// A photon map as the CPU looks it up: in which grid a point lies, which photons are around it, how much of a kernel
// there lies on surface. The text of shaders/map_lookup.glsl over a PhotonMap.
#pragma once
#include "maps/gather_settings.h"
#include "maps/grid_reader.h"
#include "maps/photon_map.h"

namespace lw {

/// Read-only view of a PhotonMap with the functions of shaders/map_lookup.glsl as members: place_on_grid(index,
/// position), bandwidth_from_counts(grid, local), caustic_radius(grid, local), covered_part(place, radius). The map
/// must outlive it.
class MapReader {
  public:
    /// `neighbours_wanted`: photons that the disc of bandwidth_from_counts() should hold.
    explicit MapReader(const PhotonMap& map, uint neighbours_wanted = GatherSettings{}.neighbours)
        : neighbours(neighbours_wanted), has_coverage(map.has_coverage()), map_(map) {}

    /// The grid, or the first cut, of a side of a triangle, or no_grid; that of its caustics, only where there are
    /// some.
    uint grid_of(uint triangle, bool front) const { return map_.grid_of_side[2 * size_t(triangle) + (front ? 0 : 1)]; }
    uint caustic_grid_of(uint triangle, bool front) const {
        return map_.caustic_grid_of(2 * size_t(triangle) + (front ? 0 : 1));
    }
    /// A grid without cells where there is none of that number.
    const SurfaceGrid& grid_at(uint index) const { return index < map_.grids.size() ? map_.grids[index] : empty_grid; }
    const Cut& cut_at(uint i) const { return map_.cuts[i]; }
    uint cell_start(uint cell) const { return map_.cell_starts[cell]; }
    uint node_coverage(uint node) const { return map_.coverage[node]; }

#include "shaders/map_lookup.glsl"

    /// As GridReader::visit_photons().
    template <class Visit>
    void visit_photons(const SurfaceGrid& grid, vec3 local, float radius, const Visit& visit) const {
        GridReader{map_}.visit_photons(grid, local, radius, visit);
    }

  private:
    static constexpr SurfaceGrid empty_grid{};
    uint neighbours;
    bool has_coverage;
    const PhotonMap& map_;
};

}  // namespace lw
