#include "maps/smooth_caustics.h"

#include <algorithm>

#include "base/parallel.h"
#include "maps/map_reader.h"
#include "maps/packing.h"
#include "scene/surface.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr float max_record = 32768;  // RGB9E5 goes to 65408
constexpr float min_steps = 1.5f;    // of the lattice in a kernel's radius: at 1 the focus of a glass ball lost 0.5 %

/// The text of shaders/caustics.glsl at lattice nodes, lamp by lamp.
class CausticNodes {
  public:
    CausticNodes(const Scene& scene, const PhotonMap& map, const std::vector<NodePoint>& nodes)
        : map_(map), surfaces_(scene), maps_(map), nodes_(nodes), lamps_(uint(scene.lights.size())) {}

    /// Adds the caustics of a node of map m to the records; false, and nothing added, where they are too sharp for it.
    bool add(uint m, uint node, std::vector<uint>& records) const {
        if (!nodes_[node].exists()) return false;
        const Surface s = surfaces_.surface_at(nodes_[node].triangle, nodes_[node].barycentrics);
        const bool front = dot(s.geometric_normal, map_.grids[m].normal) >= 0;
        const uint own = maps_.map_at(maps_.caustic_map_of(nodes_[node].triangle, front), s.position);
        if (own == no_map) return true;
        const SurfaceGrid& grid = map_.grids[own];
        const SurfaceLattice& lattice = map_.grids[m].lattice;
        const vec3 local = position_in_grid(grid, s.position);
        const float radius = maps_.caustic_radius(grid, local);
        const std::vector<vec3> light = light_at_node(m, node, grid, local, radius);
        if (radius < min_steps * std::max(lattice.step.x, lattice.step.y) && has_any(light)) return false;
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            if (largest(light[lamp] + unpack_rgb9e5(records[record(lamp, node)])) > max_record) return false;
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            if (largest(light[lamp]) > 0)
                records[record(lamp, node)] = pack_rgb9e5(unpack_rgb9e5(records[record(lamp, node)]) + light[lamp]);
        return true;
    }

  private:
    size_t record(uint lamp, uint node) const { return size_t(lamp) * nodes_.size() + node; }

    bool has_any(const std::vector<vec3>& light) const {
        return std::any_of(light.begin(), light.end(), [&](const vec3& e) { return largest(e) > 0; });
    }

    /// As records keep it: lux per unit intensity x irradiance_scale, per lamp.
    std::vector<vec3> light_at_node(uint m, uint node, const SurfaceGrid& grid, vec3 local, float radius) const {
        std::vector<vec3> light(lamps_, vec3(0));
        const float r2 = radius * radius, wide = std::min(4 * radius / grid.radius, 1.0f);
        const float covered = unpack_coverage(map_.coverage[node], radius / map_.grids[m].radius);
        const float share = kernel_peak(r2) * (1 / map_.flux_scale) * map_.irradiance_scale /
                            (1 + wide * (std::max(covered, min_coverage) - 1));
        maps_.visit_photons(grid, local, radius, [&](uint i, PhotonPlace place, float d2) {
            light[light_of(place)] += unpack_rgb9e5(map_.fluxes[i]) * (share * kernel_shape(d2 / r2));
        });
        return light;
    }

    const PhotonMap& map_;
    SurfaceReader surfaces_;
    MapReader maps_;
    const std::vector<NodePoint>& nodes_;
    uint lamps_;
};

}  // namespace

std::vector<uint> add_smooth_caustics(const Scene& scene, const std::vector<NodePoint>& nodes, const PhotonMap& map,
                                      std::vector<uint>& irradiance) {
    const CausticNodes caustics(scene, map, nodes);
    std::vector<char> smooth(nodes.size(), 0);
    parallel_for(map.grids.size() - map.caustic_grids, [&](size_t m) {
        const SurfaceLattice& lattice = map.grids[m].lattice;
        for (uint n = lattice.first_node; n < lattice.first_node + lattice.columns * lattice.rows; ++n)
            smooth[n] = caustics.add(uint(m), n, irradiance);
    });
    std::vector<uint> marks((nodes.size() + 31) / 32, 0);
    for (size_t n = 0; n < nodes.size(); ++n)
        if (smooth[n]) marks[n / 32] |= 1u << (n % 32);
    return marks;
}

}  // namespace lw
