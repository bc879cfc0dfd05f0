#include "maps/mesh_light.h"

#include "base/parallel.h"
#include "scene/surface.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint rays_to_mesh = 16;

/// A node's point of its surface, with the normal of its side.
struct Receiver {
    uint node;
    vec3 position, normal;
};

class MeshLight {
  public:
    MeshLight(const Scene& scene, const RayCaster& caster, const std::vector<uint>& visible_lamps, uint lamp)
        : caster_(caster),
          visible_lamps_(visible_lamps),
          emitters_(scene),
          lamp_(lamp),
          row_length_(visibility_row_length(uint(scene.lights.size()))) {}

    vec3 irradiance(const Receiver& at) const {
        const uint seen =
            (visible_lamps_[size_t(at.node) * row_length_ + visibility_column(lamp_)] >> visibility_shift(lamp_)) & 3u;
        if (seen == some_hidden) return vec3(0);
        if (seen == some_visible && emitters_.is_even(lamp_))
            return emitters_.even_irradiance(lamp_, at.position, at.normal);
        vec3 sum(0);
        const auto scramble = uint32_t(mix64(uint64_t(at.node) << 14 | lamp_));
        for (uint i = 0; i < rays_to_mesh; ++i) {
            const auto in =
                emitters_.arrive(lamp_, at.position, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
            if (!in || dot(in->to_light, at.normal) <= 0) continue;
            const vec3 passed = seen == some_visible
                                    ? vec3(1)
                                    : caster_.transmittance(caster_.offset(at.position, at.normal), in->position);
            sum += in->radiance * passed * (dot(in->to_light, at.normal) / (in->pdf * float(rays_to_mesh)));
        }
        return sum;
    }

  private:
    const RayCaster& caster_;
    const std::vector<uint>& visible_lamps_;
    Emitters emitters_;
    uint lamp_, row_length_;
};

}  // namespace

std::vector<vec3> find_mesh_light(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
                                  const std::vector<uint>& visible_lamps, uint lamp) {
    std::vector<vec3> light(lattice.nodes.size(), vec3(0));
    const MeshLight mesh(scene, caster, visible_lamps, lamp);
    const SurfaceReader surfaces(scene);
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        const SurfaceGrid& grid = lattice.surfaces.grids[m];
        const uint end = grid.lattice.first_node + grid.lattice.columns * grid.lattice.rows;
        for (uint n = grid.lattice.first_node; n < end; ++n) {
            if (!lattice.nodes[n].exists() || lattice.buried[n]) continue;
            const Surface s = surfaces.surface_at(lattice.nodes[n].triangle, lattice.nodes[n].barycentrics);
            const float side = dot(s.geometric_normal, grid.normal) < 0 ? -1.0f : 1.0f;
            light[n] = mesh.irradiance({n, s.position, s.geometric_normal * side});
        }
        fill_buried_nodes(lattice, uint(m), light);
    });
    return light;
}

}  // namespace lw
