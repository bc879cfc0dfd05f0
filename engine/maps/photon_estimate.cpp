#include "maps/photon_estimate.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/progress.h"
#include "maps/photon_sums.h"

namespace lw {
namespace {

vec3 total_of(const std::vector<vec4>& sums, uint lamp) {
    const vec4* part = sums.data() + PhotonSums::sums_per_lamp * lamp;
    return vec3((part[0] + part[1]) + (part[2] + part[3]));
}

constexpr float least_in_steps = 0.75f;

}  // namespace

float bandwidth_at_node(const GridReader& reader, const SurfaceGrid& grid, vec3 local) {
    const float least = least_in_steps * std::max(grid.lattice.step.x, grid.lattice.step.y);
    return std::min(std::max(reader.bandwidth_from_counts(grid, local), least), grid.radius);
}

std::vector<vec3> estimate_from_photons(const Scene& scene, const Lattice& lattice, const PhotonRecords& photons) {
    const size_t nodes = lattice.nodes.size(), lamps = scene.lights.size();
    const GridReader reader{photons};
    std::vector<vec3> light(nodes * lamps, vec3(0));
    Progress progress("light of photons", nodes);
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        const SurfaceGrid& grid = lattice.surfaces.grids[m];
        const PhotonSums grid_sums(photons, grid);
        std::vector<vec4> sums(PhotonSums::sums_per_lamp * lamps);
        const uint end = grid.lattice.first_node + grid.lattice.columns * grid.lattice.rows;
        for (uint node = grid.lattice.first_node; node < end; ++node) {
            if (!lattice.nodes[node].exists()) continue;
            std::fill(sums.begin(), sums.end(), vec4(0));
            const vec3 local = node_in_grid(lattice, grid, node);
            const float radius = bandwidth_at_node(reader, grid, local);
            grid_sums.add(local, radius, sums);
            const float covered = std::max(unpack_coverage(lattice.coverage[node], radius / grid.radius), min_coverage);
            const float share = kernel_peak(radius * radius) / (photons.flux_scale * covered);
            for (uint lamp = 0; lamp < lamps; ++lamp) light[lamp * nodes + node] = total_of(sums, lamp) * share;
        }
        progress.step(end - grid.lattice.first_node);
    });
    return light;
}

}  // namespace lw
