#include "maps/visibility.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr int rays_to_mesh = 3;

/// A point of a patch's surface and the direction its lit side faces.
struct Receiver {
    vec3 position, normal;
};

class LampRays {
  public:
    LampRays(const Scene& scene, const RayCaster& caster) : scene_(scene), caster_(caster), emitters_(scene) {}

    /// The visibility bits (some_visible, some_hidden) of one lamp at a receiver.
    uint look(uint lamp, const Receiver& receiver, Rng& rng) const {
        uint bits = 0;
        const int rays = is_delta(scene_.lights[lamp].type) ? 1 : rays_to_mesh;
        for (int i = 0; i < rays; ++i) {
            const float u = (float(i) + rng.next()) / float(rays);
            bits |= look_at(emitters_.arrive(lamp, receiver.position, u, rng.next()), receiver);
        }
        return bits;
    }

  private:
    uint look_at(const std::optional<Incident>& in, const Receiver& receiver) const {
        if (!in || dot(in->to_light, receiver.normal) <= 0) return some_hidden;
        const vec3 passed = caster_.transmittance(caster_.offset(receiver.position, receiver.normal), in->position);
        return (passed == vec3(1) ? 0 : some_hidden) | (passed == vec3(0) ? 0 : some_visible);
    }

    const Scene& scene_;
    const RayCaster& caster_;
    Emitters emitters_;
};

/// Fills the bits of all nodes of a lattice: own[node] as the node's own bits, joined with those of its 3 x 3
/// neighbours as the bits of its surroundings.
void spread(const SurfaceLattice& lattice, uint length, const std::vector<uint>& own, std::vector<uint>& joined) {
    const int columns = int(lattice.columns), rows = int(lattice.rows);
    for (uint i = lattice.first_node * length; i < (lattice.first_node + lattice.columns * lattice.rows) * length; ++i)
        joined[i] |= own[i] << own_shift;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, rows - 1); ++ny)
                for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, columns - 1); ++nx)
                    for (uint c = 0; c < length; ++c)
                        joined[(lattice.first_node + uint(y * columns + x)) * length + c] |=
                            own[(lattice.first_node + uint(ny * columns + nx)) * length + c];
}

}  // namespace

std::vector<uint> find_visibility(const Scene& scene, const RayCaster& caster, const Lattice& all) {
    const std::vector<NodePoint>& nodes = all.nodes;
    const auto lamps = uint(scene.lights.size()), length = visibility_row_length(lamps);
    const LampRays rays(scene, caster);
    const SurfaceReader surfaces(scene);
    std::vector<uint> own(nodes.size() * length, 0), joined(nodes.size() * length, 0);
    Progress progress("lamp visibility", nodes.size());
    parallel_for(all.surfaces.grids.size(), [&](size_t m) {
        const SurfaceLattice& lattice = all.surfaces.grids[m].lattice;
        const uint end = lattice.first_node + lattice.columns * lattice.rows;
        for (uint n = lattice.first_node; n < end; ++n) {
            if (!nodes[n].exists()) continue;
            const Surface s = surfaces.surface_at(nodes[n].triangle, nodes[n].barycentrics);
            const float side = dot(s.geometric_normal, all.surfaces.grids[m].normal) < 0 ? -1.0f : 1.0f;
            Rng rng(1, 1, n);
            for (uint lamp = 0; lamp < lamps; ++lamp)
                own[n * length + visibility_column(lamp)] |=
                    rays.look(lamp, {s.position, s.geometric_normal * side}, rng) << visibility_shift(lamp);
        }
        spread(lattice, length, own, joined);
        progress.step(end - lattice.first_node);
    });
    return joined;
}

}  // namespace lw
