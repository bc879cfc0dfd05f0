#include "maps/irradiance.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/progress.h"
#include "maps/buried.h"
#include "maps/grid_reader.h"
#include "maps/packing.h"
#include "maps/photon_sums.h"
#include "maps/smoothing.h"
#include "scene/surface.h"
#include "shaders/color.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint rays_to_mesh = 16;
constexpr float max_record = 4096;

/// Light at the nodes of one grid after another.
class NodeLight {
  public:
    explicit NodeLight(const IrradianceInput& input)
        : scene_(input.scene),
          caster_(input.caster),
          grids_(input.lattice.surfaces.grids),
          nodes_(input.lattice.nodes),
          coverage_(input.lattice.coverage),
          photons_(input.photons),
          visible_lamps_(input.visible_lamps),
          max_radius_(input.lattice.radius),
          surfaces_(input.scene),
          cells_{input.photons, input.lattice.radius},
          emitters_(input.scene),
          lamps_(uint(input.scene.lights.size())),
          adds_meshes_(!input.visible_lamps.empty() && has_meshes(input.scene)) {}

    /// Writes light[lamp * all nodes + node] for the nodes of grid m.
    void light_grid(uint m, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = grids_[m].lattice;
        const LatticePlanes reflected = reflected_light(grids_[m]);
        for (uint y = 0; y < lattice.rows; ++y)
            for (uint x = 0; x < lattice.columns; ++x)
                for (uint lamp = 0; lamp < lamps_; ++lamp)
                    for (uint c = 0; c < 3; ++c)
                        light[index(lamp, lattice.first_node + y * lattice.columns + x)][int(c)] =
                            reflected.row(3 * lamp + c, int(y))[x];
        if (adds_meshes_) add_direct(m, light);
    }

  private:
    size_t index(uint lamp, uint node) const { return size_t(lamp) * nodes_.size() + node; }

    /// What the photons bring to the nodes of a grid, smoothed: three planes per lamp. The weights of the smoothing are
    /// those at the file's powers for all lamps alike, so that the result stays linear in the powers.
    LatticePlanes reflected_light(const SurfaceGrid& grid) const {
        const SurfaceLattice& lattice = grid.lattice;
        LatticePlanes light(lattice.columns, lattice.rows, 3 * lamps_), brightness(lattice.columns, lattice.rows, 1),
            existence(lattice.columns, lattice.rows, 1);
        const PhotonSums photons(photons_, grid, max_radius_);
        std::vector<vec4> sums(PhotonSums::sums_per_lamp * lamps_);
        for (uint y = 0; y < lattice.rows; ++y)
            for (uint x = 0; x < lattice.columns; ++x) {
                const uint node = lattice.first_node + y * lattice.columns + x;
                if (!nodes_[node].exists()) continue;
                std::fill(sums.begin(), sums.end(), vec4(0));
                const float share = sum_photons(grid, photons, node, sums);
                existence.row(0, int(y))[x] = 1;
                for (uint lamp = 0; lamp < lamps_; ++lamp) {
                    const vec3 e = vec3(total_of(sums, lamp)) * share;
                    for (uint c = 0; c < 3; ++c) light.row(3 * lamp + c, int(y))[x] = e[int(c)];
                    brightness.row(0, int(y))[x] += luminance(e * scene_.lights[lamp].intensity);
                }
            }
        return smooth(light, brightness, existence);
    }

    static vec4 total_of(const std::vector<vec4>& sums, uint lamp) {
        const vec4* part = sums.data() + PhotonSums::sums_per_lamp * lamp;
        return (part[0] + part[1]) + (part[2] + part[3]);
    }

    /// Adds the photons around a node to the sums of each lamp. Returns the factor from the sums to lux: that of the
    /// kernel, kernel_peak(), over the flux scale and the coverage.
    float sum_photons(const SurfaceGrid& grid, const PhotonSums& photons, uint node, std::vector<vec4>& sums) const {
        const SurfaceLattice& lattice = grid.lattice;
        const uint i = node - lattice.first_node;
        const vec3 at = surfaces_.surface_at(nodes_[node].triangle, nodes_[node].barycentrics).position;
        const vec2 uv = lattice.low + vec2(float(i % lattice.columns), float(i / lattice.columns)) * lattice.step;
        const vec3 local(uv, position_in_grid(grid, at).z);
        const float radius = cells_.bandwidth_from_counts(grid, local);
        photons.add(local, radius, sums);
        // kernel_peak(), but for the order of the product: the last bit of the records hangs on it.
        return kernel_height / (lw_pi * radius * radius) * (1.0f / photons_.flux_scale) /
               std::max(unpack_coverage(coverage_[node], radius / grid.radius), min_coverage);
    }

    /// Adds the direct light of mesh lamps to the nodes of grid m.
    void add_direct(uint m, std::vector<vec3>& light) const {
        const SurfaceLattice& lattice = grids_[m].lattice;
        const uint count = lattice.columns * lattice.rows;
        std::vector<char> buried(count, 1);
        std::vector<vec3> direct(size_t(count) * lamps_, vec3(0));
        for (uint i = 0; i < count; ++i) {
            const uint node = lattice.first_node + i;
            if (!nodes_[node].exists()) continue;
            const Surface s = surfaces_.surface_at(nodes_[node].triangle, nodes_[node].barycentrics);
            const vec3 n = s.geometric_normal * (dot(s.geometric_normal, grids_[m].normal) < 0 ? -1.0f : 1.0f);
            Rng rng(1, 2, node);
            buried[i] = is_buried(caster_, s.position, n, clearance_of(max_radius_), rng);
            if (buried[i]) continue;
            for (uint lamp = 0; lamp < lamps_; ++lamp)
                if (!is_delta(scene_.lights[lamp].type))
                    direct[size_t(i) * lamps_ + lamp] = direct_of_mesh(lamp, node, s.position, n);
        }
        for (uint i = 0; i < count; ++i) {
            if (!nodes_[lattice.first_node + i].exists()) continue;
            for (uint lamp = 0; lamp < lamps_; ++lamp)
                light[index(lamp, lattice.first_node + i)] +=
                    buried[i] ? around(lattice, i, buried, direct, lamp) : direct[size_t(i) * lamps_ + lamp];
        }
    }

    vec3 direct_of_mesh(uint lamp, uint node, vec3 position, vec3 n) const {
        const uint length = visibility_row_length(lamps_);
        const uint seen = (visible_lamps_[node * length + visibility_column(lamp)] >> visibility_shift(lamp)) & 3u;
        if (seen == some_hidden) return vec3(0);
        if (seen == some_visible && emitters_.is_even(lamp)) return emitters_.even_irradiance(lamp, position, n);
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

    /// The mean direct light of the neighbours of node i that are not buried. A buried node takes it, because the
    /// surface beside the furniture is interpolated between the two.
    vec3 around(const SurfaceLattice& lattice, uint i, const std::vector<char>& buried, const std::vector<vec3>& direct,
                uint lamp) const {
        const int columns = int(lattice.columns), x = int(i) % columns, y = int(i) / columns;
        vec3 sum(0);
        float open = 0;
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, int(lattice.rows) - 1); ++ny)
            for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, columns - 1); ++nx) {
                const size_t other = size_t(ny * columns + nx);
                if (buried[other]) continue;
                sum += direct[other * lamps_ + lamp];
                open += 1;
            }
        return open > 0 ? sum / open : vec3(0);
    }

    static bool has_meshes(const Scene& scene) {
        return std::any_of(scene.lights.begin(), scene.lights.end(),
                           [](const Light& lamp) { return !is_delta(lamp.type); });
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const std::vector<SurfaceGrid>& grids_;
    const std::vector<NodePoint>& nodes_;
    const std::vector<uint>& coverage_;
    const PhotonRecords& photons_;
    const std::vector<uint>& visible_lamps_;
    float max_radius_;
    SurfaceReader surfaces_;
    GridReader cells_;
    Emitters emitters_;
    uint lamps_;
    bool adds_meshes_;  // their direct light
};

}  // namespace

NodeIrradiance find_irradiance(const IrradianceInput& input) {
    const std::vector<SurfaceGrid>& grids = input.lattice.surfaces.grids;
    const size_t nodes = input.lattice.nodes.size();
    std::vector<vec3> light(nodes * input.scene.lights.size(), vec3(0));
    const NodeLight node_light(input);
    Progress progress("irradiance", nodes);
    parallel_for(grids.size(), [&](size_t m) {
        node_light.light_grid(uint(m), light);
        progress.step(grids[m].lattice.columns * grids[m].lattice.rows);
    });
    float top = 0;
    for (const vec3& e : light) top = std::max(top, largest(e));
    NodeIrradiance packed{std::vector<uint>(light.size()),
                          top > 0 ? std::exp2(std::floor(std::log2(max_record / top))) : 1.0f};
    parallel_for(
        light.size(), [&](size_t i) { packed.records[i] = pack_rgb9e5(light[i] * packed.scale); }, 4096);
    return packed;
}

}  // namespace lw
