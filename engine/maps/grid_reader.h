// Reads the photons of a grid around a point on the CPU: the text of shaders/grid.glsl over records in memory.
#pragma once
#include <cmath>

#include "maps/photon_map.h"

namespace lw {

/// Records must outlive it.
struct GridReader {
    const PhotonRecords& records;
    uint neighbours = 300;  // photons that bandwidth_from_counts() wants under a kernel

    uint cell_start(uint cell) const { return records.cell_starts[cell]; }

#include "shaders/grid.glsl"

    /// Calls visit(reference, place, squared distance) for the photons of a grid within `radius` m of a point in its
    /// frame that lie on the same surface.
    template <class Visit>
    void visit_photons(const SurfaceGrid& grid, vec3 local, float radius, const Visit& visit) const {
        const vec3 reach(radius, radius, 0);
        const ivec2 low = grid_cell_of(local - reach, grid), high = grid_cell_of(local + reach, grid);
        for (int y = low.y; y <= high.y; ++y) {
            const uvec2 span = row_span(grid, low.x, high.x, y);
            for (uint i = span.x; i < span.y; ++i) {
                const PhotonPlace place = records.places[i];
                const vec3 d = place_in_grid(place, grid) - local;
                const float d2 = dot(d, d);
                if (d2 < radius * radius && on_same_surface(d.z, d2, grid.radius)) visit(i, place, d2);
            }
        }
    }
};

}  // namespace lw
