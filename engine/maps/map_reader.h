// A photon map as the CPU looks it up: on which map a point lies, which photons are around it, how much of a kernel
// there lies on surface. The text of shaders/map_lookup.glsl over a PhotonMap.
#pragma once
#include "maps/gather_settings.h"
#include "maps/photon_map.h"

namespace lw {

/// Read-only view of a PhotonMap with the functions of shaders/map_lookup.glsl as members: place_on(map, position),
/// bandwidth_from_counts(grid, local), caustic_radius(grid, local), covered_part(place, radius). The map must outlive
/// it.
class MapReader {
  public:
    /// `neighbours`: photons that bandwidth_from_counts() looks for.
    explicit MapReader(const PhotonMap& map, uint neighbours_wanted = GatherSettings{}.neighbours)
        : neighbours(neighbours_wanted), has_coverage(map.has_coverage()), map_(map) {}

    /// The map of a side of a triangle, or no_map; of its caustics, only where the map has some.
    uint map_of(uint triangle, bool front) const { return map_.triangle_maps[2 * size_t(triangle) + (front ? 0 : 1)]; }
    uint caustic_map_of(uint triangle, bool front) const {
        return map_.caustic_map_of(2 * size_t(triangle) + (front ? 0 : 1));
    }
    /// A grid without cells for no_map.
    const SurfaceGrid& grid_at(uint map) const { return map < map_.grids.size() ? map_.grids[map] : no_grid; }
    bool is_cut(uint map) const { return map < map_.grids.size() && map_.grids[map].columns == 0; }
    uint cell_start(uint cell) const { return map_.cell_starts[cell]; }
    uint node_coverage(uint node) const { return map_.coverage[node]; }

#include "shaders/map_lookup.glsl"

    /// Calls visit(reference, place, squared distance) for the photons of a grid within `radius` of a point in its
    /// frame that lie on the same surface.
    template <class Visit>
    void visit_photons(const SurfaceGrid& grid, vec3 local, float radius, const Visit& visit) const {
        const vec3 reach(radius, radius, 0);
        const ivec2 low = cell_of(local - reach, grid), high = cell_of(local + reach, grid);
        for (int y = low.y; y <= high.y; ++y) {
            const uvec2 span = row_span(grid, low.x, high.x, y);
            for (uint i = span.x; i < span.y; ++i) {
                const PhotonPlace place = map_.places[i];
                const vec3 d = place_in_grid(place, grid) - local;
                const float d2 = dot(d, d);
                if (d2 < radius * radius && on_same_surface(d.z, d2, map_.settings.radius)) visit(i, place, d2);
            }
        }
    }

  private:
    static constexpr SurfaceGrid no_grid{};
    uint neighbours;
    bool has_coverage;
    const PhotonMap& map_;
};

}  // namespace lw
