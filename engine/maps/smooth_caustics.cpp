#include "maps/smooth_caustics.h"

#include <algorithm>

#include "base/parallel.h"
#include "maps/grid_reader.h"
#include "maps/packing.h"
#include "scene/surface.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr float max_record = 32768;  // RGB9E5 goes to 65408
constexpr float min_steps = 1.5f;    // lattice steps, least kernel radius: at 1 the focus of a glass ball lost 0.5 %

/// What shaders/caustics.glsl gathers, at lattice nodes, lamp by lamp.
class CausticNodes {
  public:
    CausticNodes(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics, float irradiance_scale)
        : surfaces_(scene),
          lattice_(lattice),
          caustics_(caustics),
          reader_{caustics.records},
          irradiance_scale_(irradiance_scale),
          lamps_(uint(scene.lights.size())) {}

    /// Adds the caustics of a node of grid m to the records; false, and nothing added, where they are too sharp for it.
    bool add(uint m, uint node, std::vector<uint>& records) const {
        const NodePoint& point = lattice_.nodes[node];
        if (!point.exists()) return false;
        const Surface s = surfaces_.surface_at(point.triangle, point.barycentrics);
        const uint own = grid_of(m, point.triangle, s);
        if (own == no_grid) return true;
        const SurfaceGrid& grid = caustics_.surfaces.grids[own];
        const SurfaceLattice& lattice = lattice_.surfaces.grids[m].lattice;
        const vec3 local = position_in_grid(grid, s.position);
        const float radius = reader_.caustic_radius(grid, local);
        const std::vector<vec3> light = light_at_node(m, node, grid, local, radius);
        if (radius < min_steps * std::max(lattice.step.x, lattice.step.y) && has_any(light)) return false;
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            if (largest(light[lamp] + unpack_rgb9e5(records[record(lamp, node)])) > max_record) return false;
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            if (largest(light[lamp]) > 0)
                records[record(lamp, node)] = pack_rgb9e5(unpack_rgb9e5(records[record(lamp, node)]) + light[lamp]);
        return true;
    }

    /// Lux of each lamp at a node of grid m for intensity 1, if irradiance_scale is 1, blurred over min_steps at least;
    /// none where no caustics are.
    std::vector<vec3> blurred(uint m, uint node) const {
        const NodePoint& point = lattice_.nodes[node];
        if (!point.exists()) return {};
        const Surface s = surfaces_.surface_at(point.triangle, point.barycentrics);
        const uint own = grid_of(m, point.triangle, s);
        if (own == no_grid) return {};
        const SurfaceGrid& grid = caustics_.surfaces.grids[own];
        const vec2 step = lattice_.surfaces.grids[m].lattice.step;
        const vec3 local = position_in_grid(grid, s.position);
        const float radius = std::max(reader_.caustic_radius(grid, local), min_steps * std::max(step.x, step.y));
        return light_at_node(m, node, grid, local, std::min(radius, grid.radius));
    }

  private:
    /// The grid of caustics at a point of grid m of the lattice.
    uint grid_of(uint m, uint triangle, const Surface& s) const {
        const bool front = dot(s.geometric_normal, lattice_.surfaces.grids[m].normal) >= 0;
        return caustics_.surfaces.behind_cuts(caustics_.surfaces.grid_of_side[2 * size_t(triangle) + (front ? 0 : 1)],
                                              s.position);
    }

    size_t record(uint lamp, uint node) const { return size_t(lamp) * lattice_.nodes.size() + node; }

    bool has_any(const std::vector<vec3>& light) const {
        return std::any_of(light.begin(), light.end(), [&](const vec3& e) { return largest(e) > 0; });
    }

    /// The caustic light at a node per lamp, in the unit of records: lux for intensity 1 times irradiance_scale.
    std::vector<vec3> light_at_node(uint m, uint node, const SurfaceGrid& grid, vec3 local, float radius) const {
        std::vector<vec3> light(lamps_, vec3(0));
        const float r2 = radius * radius, wide = std::min(4 * radius / grid.radius, 1.0f);
        const float covered = unpack_coverage(lattice_.coverage[node], radius / lattice_.surfaces.grids[m].radius);
        const float share = kernel_peak(r2) * (1.0f / caustics_.records.flux_scale) * irradiance_scale_ /
                            (1 + wide * (std::max(covered, min_coverage) - 1));
        reader_.visit_photons(grid, local, radius, [&](uint i, PhotonPlace place, float d2) {
            light[light_of(place)] += unpack_rgb9e5(caustics_.records.fluxes[i]) * (share * kernel_shape(d2 / r2));
        });
        return light;
    }

    SurfaceReader surfaces_;
    const Lattice& lattice_;
    const PhotonGrids& caustics_;
    GridReader reader_;
    float irradiance_scale_;
    uint lamps_;
};

}  // namespace

SmoothCaustics add_smooth_caustics(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics,
                                   NodeIrradiance irradiance) {
    const CausticNodes caustic_nodes(scene, lattice, caustics, irradiance.scale);
    std::vector<char> smooth(lattice.nodes.size(), 0);
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        const SurfaceLattice& nodes = lattice.surfaces.grids[m].lattice;
        for (uint n = nodes.first_node; n < nodes.first_node + nodes.columns * nodes.rows; ++n)
            smooth[n] = caustic_nodes.add(uint(m), n, irradiance.records);
    });
    std::vector<uint> marks((smooth.size() + 31) / 32, 0);
    for (size_t n = 0; n < smooth.size(); ++n)
        if (smooth[n]) marks[n / 32] |= 1u << (n % 32);
    return {std::move(irradiance), std::move(marks)};
}

std::vector<vec3> estimate_caustics(const Scene& scene, const Lattice& lattice, const PhotonGrids& caustics) {
    std::vector<vec3> light;
    if (caustics.surfaces.grids.empty()) return light;
    const size_t all_nodes = lattice.nodes.size();
    light.resize(all_nodes * scene.lights.size(), vec3(0));
    const CausticNodes caustic_nodes(scene, lattice, caustics, 1);
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        const SurfaceLattice& nodes = lattice.surfaces.grids[m].lattice;
        for (uint n = nodes.first_node; n < nodes.first_node + nodes.columns * nodes.rows; ++n) {
            const std::vector<vec3> of_lamps = caustic_nodes.blurred(uint(m), n);
            for (size_t lamp = 0; lamp < of_lamps.size(); ++lamp) light[lamp * all_nodes + n] = of_lamps[lamp];
        }
    });
    return light;
}

}  // namespace lw
