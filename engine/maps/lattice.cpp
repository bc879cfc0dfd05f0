#include "maps/lattice.h"

#include <algorithm>

#include "base/parallel.h"
#include "maps/buried.h"
#include "maps/coverage.h"
#include "scene/surface.h"

namespace lw {
namespace {

constexpr int rays_to_open = 4;   // that must all be short before a node counts as buried
constexpr float burying = 0.15f;  // scales: what is closer to a node buries it

/// Which nodes lie under something that rests on their surface.
std::vector<char> find_buried(const Scene& scene, const RayCaster& caster, const Partition& partition,
                              const Nodes& nodes) {
    const SurfaceReader surfaces(scene);
    std::vector<char> buried(nodes.points.size(), 0);
    parallel_for(nodes.surfaces.grids.size(), [&](size_t m) {
        const SurfaceGrid& grid = nodes.surfaces.grids[m];
        const float clearance = burying * partition.scales[nodes.surfaces.patches[m]];
        const uint end = grid.lattice.first_node + grid.lattice.columns * grid.lattice.rows;
        for (uint n = grid.lattice.first_node; n < end; ++n) {
            if (!nodes.points[n].exists()) continue;
            const Surface s = surfaces.surface_at(nodes.points[n].triangle, nodes.points[n].barycentrics);
            const float side = dot(s.geometric_normal, grid.normal) < 0 ? -1.0f : 1.0f;
            Rng rng(1, 2, n);
            buried[n] = is_buried(caster, s.position, s.geometric_normal * side, {clearance, rays_to_open, 0.1f}, rng);
        }
    });
    return buried;
}

}  // namespace

Lattice lay_lattice(const Scene& scene, const RayCaster& caster, const Partition& partition, PatchGrids surfaces) {
    Nodes nodes = lay_nodes(scene, partition, std::move(surfaces));
    std::vector<uint> coverage = find_coverage({scene, caster, partition, nodes});
    std::vector<char> buried = find_buried(scene, caster, partition, nodes);
    return {.surfaces = std::move(nodes.surfaces),
            .nodes = std::move(nodes.points),
            .coverage = std::move(coverage),
            .buried = std::move(buried)};
}

vec3 node_in_grid(const Lattice& all, const SurfaceGrid& grid, uint node) {
    const uint i = node - grid.lattice.first_node;
    const vec2 cells(float(i % grid.lattice.columns), float(i / grid.lattice.columns));
    return vec3(grid.lattice.low + cells * grid.lattice.step, all.nodes[node].height);
}

void fill_buried_nodes(const Lattice& all, uint m, std::span<vec3> light) {
    const SurfaceLattice& lattice = all.surfaces.grids[m].lattice;
    const int columns = int(lattice.columns), rows = int(lattice.rows);
    const auto node_at = [&](int x, int y) { return lattice.first_node + uint(y * columns + x); };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            if (!all.buried[node_at(x, y)]) continue;
            vec3 sum(0);
            float open = 0;
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, rows - 1); ++ny)
                for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, columns - 1); ++nx)
                    if (const uint n = node_at(nx, ny); all.nodes[n].exists() && !all.buried[n])
                        sum += light[n], ++open;
            light[node_at(x, y)] = open > 0 ? sum / open : vec3(0);
        }
}

}  // namespace lw
