#include "maps/irradiance.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/progress.h"
#include "maps/coverage.h"
#include "maps/estimate.h"
#include "maps/packing.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint rays_to_mesh = 16;
constexpr float brightest_record = 4096;
constexpr int smoothing_reach = 3;         // nodes
constexpr float smoothing_spread2 = 2.5f;  // variance, nodes squared
constexpr float smoothing_range = 0.12f;   // twice the noise of 300 photons

float largest(vec3 v) { return std::max({v.x, v.y, v.z}); }

/// Light at the nodes of one map after another.
class NodeLight : public PhotonEstimator {
  public:
    NodeLight(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const std::vector<NodePoint>& nodes)
        : PhotonEstimator(scene, map, none_, {}),
          scene_(scene),
          caster_(caster),
          map_(map),
          nodes_(nodes),
          emitters_(scene),
          lamps_(uint(scene.lights.size())) {}

    /// Writes light[lamp * all nodes + node] for the nodes of map m.
    void light_map(uint m, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = map_.grids[m].lattice;
        for (uint i = 0; i < lattice.columns * lattice.rows; ++i)
            if (nodes_[lattice.first_node + i].exists()) add_reflected(map_.grids[m], i, light);
        smooth_reflected(lattice, light);
        if (map_.has_visible_lamps()) add_direct(m, light);
    }

  private:
    void add_direct(uint m, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = map_.grids[m].lattice;
        std::vector<char> buried(lattice.columns * lattice.rows, 1);
        for (uint i = 0; i < buried.size(); ++i) {
            const uint node = lattice.first_node + i;
            if (!nodes_[node].exists()) continue;
            const Surface s = surface_at(nodes_[node].triangle, nodes_[node].barycentrics);
            const vec3 n = s.geometric_normal * (dot(s.geometric_normal, map_.grids[m].normal) < 0 ? -1.0f : 1.0f);
            Rng rng(1, 2, node);
            buried[i] = is_buried(caster_, s.position, n, clearance_of(map_.settings.radius), rng);
            if (!buried[i]) add_direct_of_meshes(node, s.position, n, light);
        }
        for (uint i = 0; i < buried.size(); ++i)
            if (buried[i] && nodes_[lattice.first_node + i].exists()) borrow_direct(m, i, buried, light);
    }

    /// What all lamps of the file bring to a node, one number.
    float brightness(uint node, const std::vector<vec3>& light) const {
        float sum = 0;
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            sum += dot(light[index(lamp, node)] * scene_.lights[lamp].intensity, vec3(0.2126f, 0.7152f, 0.0722f));
        return sum;
    }

    /// Averages each node with those around that differ by no more than the estimate's noise may explain (bilateral
    /// filter, Tomasi & Manduchi 1998): the mottle of neighbouring estimates goes, gradients and edges stay. The
    /// weights are those at the file's powers for all lamps alike, so that the result stays linear in the powers.
    void smooth_reflected(const SurfaceLattice& lattice, std::vector<vec3>& light) const {
        const int columns = int(lattice.columns), rows = int(lattice.rows);
        const uint count = lattice.columns * lattice.rows;
        std::vector<float> bright(count);
        for (uint i = 0; i < count; ++i) bright[i] = brightness(lattice.first_node + i, light);
        std::vector<vec3> smoothed(size_t(count) * lamps_, vec3(0));
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const size_t own = size_t(y * columns + x);
                float total = 0;
                for (int ny = std::max(y - smoothing_reach, 0); ny <= std::min(y + smoothing_reach, rows - 1); ++ny)
                    for (int nx = std::max(x - smoothing_reach, 0); nx <= std::min(x + smoothing_reach, columns - 1);
                         ++nx) {
                        const size_t other = size_t(ny * columns + nx);
                        const float mean = 0.5f * (bright[own] + bright[other]);
                        const float change = mean > 0 ? (bright[own] - bright[other]) / (mean * smoothing_range) : 0.0f;
                        const auto distance2 = float((nx - x) * (nx - x) + (ny - y) * (ny - y));
                        const float weight = std::exp(-0.5f * (change * change + distance2 / smoothing_spread2));
                        if (!nodes_[lattice.first_node + other].exists() || weight < 1e-3f) continue;
                        total += weight;
                        for (uint lamp = 0; lamp < lamps_; ++lamp)
                            smoothed[own * lamps_ + lamp] +=
                                light[index(lamp, lattice.first_node + uint(other))] * weight;
                    }
                for (uint lamp = 0; lamp < lamps_ && total > 0; ++lamp) smoothed[own * lamps_ + lamp] /= total;
            }
        for (uint i = 0; i < count; ++i)
            for (uint lamp = 0; lamp < lamps_; ++lamp)
                light[index(lamp, lattice.first_node + i)] = smoothed[size_t(i) * lamps_ + lamp];
    }

    size_t index(uint lamp, uint node) const { return size_t(lamp) * nodes_.size() + node; }

    void add_reflected(const SurfaceGrid& grid, uint i, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = grid.lattice;
        const uint node = lattice.first_node + i;
        const vec3 at = surface_at(nodes_[node].triangle, nodes_[node].barycentrics).position;
        const vec2 uv = lattice.low + vec2(float(i % lattice.columns), float(i / lattice.columns)) * lattice.step;
        const vec3 local(uv, position_in_grid(grid, at).z);
        const float radius = bandwidth_from_counts(grid, local), r2 = radius * radius;
        const float share = 2.0f / (lw_pi * r2) * inverse_flux_scale /
                            std::max(unpack_coverage(map_.coverage[node], radius / grid.radius), least_coverage);
        const ivec2 low = cell_of(local - vec3(radius, radius, 0), grid),
                    high = cell_of(local + vec3(radius, radius, 0), grid);
        for (int y = low.y; y <= high.y; ++y) {
            const uvec2 span = row_span(grid, low.x, high.x, y);
            for (uint p = span.x; p < span.y; ++p) {
                const PhotonPlace place = photon_place(p);
                const vec3 d = place_in_grid(place, grid) - local;
                const float d2 = dot(d, d);
                if (d2 < r2 && on_same_surface(d.z, d2, max_radius))
                    light[index(light_of(place), node)] += unpack_rgb9e5(photon_flux(p)) * (share * (1 - d2 / r2));
            }
        }
    }

    vec3 direct_of_mesh(uint lamp, uint node, vec3 position, vec3 n) const {
        const uint words = visibility_words(lamps_);
        const uint seen = (map_.visible_lamps[node * words + visibility_word(lamp)] >> visibility_shift(lamp)) & 3u;
        if (seen == some_hidden) return vec3(0);
        vec3 sum(0);
        const auto scramble = uint32_t(mix64(uint64_t(node) << 14 | lamp));
        for (uint i = 0; i < rays_to_mesh; ++i) {
            const auto in = emitters_.arrive(lamp, position, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
            if (!in || dot(in->to_light, n) <= 0) continue;
            const vec3 passed =
                seen == some_visible ? vec3(1) : caster_.transmittance(caster_.offset(position, n), in->position);
            sum += in->radiance * passed * (dot(in->to_light, n) / (in->pdf * float(rays_to_mesh)));
        }
        return sum;
    }

    void add_direct_of_meshes(uint node, vec3 position, vec3 n, std::vector<vec3>& light) const {
        for (uint lamp = 0; lamp < lamps_; ++lamp)
            if (scene_.lights[lamp].type == light_mesh)
                light[index(lamp, node)] += direct_of_mesh(lamp, node, position, n);
    }

    /// A node under a piece of furniture takes the light of its neighbours in the open: the surface beside it is looked
    /// up between the two.
    void borrow_direct(uint m, uint i, const std::vector<char>& buried, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = map_.grids[m].lattice;
        const int columns = int(lattice.columns), x = int(i) % columns, y = int(i) / columns;
        std::vector<uint> open;
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, int(lattice.rows) - 1); ++ny)
            for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, columns - 1); ++nx)
                if (!buried[size_t(ny * columns + nx)]) open.push_back(uint(ny * columns + nx));
        for (uint lamp = 0; lamp < lamps_; ++lamp) {
            if (scene_.lights[lamp].type != light_mesh) continue;
            for (uint other : open) {
                const uint node = lattice.first_node + other;
                const Surface s = surface_at(nodes_[node].triangle, nodes_[node].barycentrics);
                const vec3 n = s.geometric_normal * (dot(s.geometric_normal, map_.grids[m].normal) < 0 ? -1.0f : 1.0f);
                light[index(lamp, lattice.first_node + i)] +=
                    direct_of_mesh(lamp, node, s.position, n) / float(open.size());
            }
        }
    }

    static inline const std::vector<vec3> none_;
    const Scene& scene_;
    const RayCaster& caster_;
    const PhotonMap& map_;
    const std::vector<NodePoint>& nodes_;
    Emitters emitters_;
    uint lamps_;
};

}  // namespace

std::vector<uint> find_irradiance(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                  const std::vector<NodePoint>& nodes, float& scale) {
    std::vector<vec3> light(nodes.size() * scene.lights.size(), vec3(0));
    const NodeLight node_light(scene, caster, map, nodes);
    Progress progress("irradiance", nodes.size());
    parallel_for(map.grids.size(), [&](size_t m) {
        node_light.light_map(uint(m), light);
        progress.step(map.grids[m].lattice.columns * map.grids[m].lattice.rows);
    });
    float top = 0;
    for (const vec3& e : light) top = std::max(top, largest(e));
    scale = top > 0 ? std::exp2(std::floor(std::log2(brightest_record / top))) : 1.0f;
    std::vector<uint> packed(light.size());
    parallel_for(
        packed.size(), [&](size_t i) { packed[i] = pack_rgb9e5(light[i] * scale); }, 4096);
    return packed;
}

}  // namespace lw
