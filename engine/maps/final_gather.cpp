#include "maps/final_gather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "maps/photon_estimate.h"
#include "maps/seen_light.h"
#include "maps/smoothing.h"
#include "scene/surface.h"
#include "shaders/color.h"
#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float rays_per_photon = 0.5f;  // around a node, of the lamp
constexpr float min_rays = 4, max_rays = 64;
constexpr uint probing_rays = 8;  // from some nodes of a patch without photons, to learn whether it is dark
constexpr size_t probed_nodes = 5;
constexpr float rays_count_up_to = 3;  // times the mean of a patch: brighter surfaces are left to photons
constexpr int max_path = 16;           // surfaces on the way of a ray
constexpr float all_light = std::numeric_limits<float>::infinity();

/// A ray that looks for light, and the greatest irradiance that it counts, as luminance, lux.
struct GatherRay {
    vec3 origin, direction;
    float limit;
};

class NodeGather {
  public:
    NodeGather(const GatherInput& input, const KnownLight& known)
        : in_(input),
          lamp_(known.lamp),
          estimate_(known.estimate),
          surfaces_(input.scene),
          light_(input.scene, input.lattice, input.visible_lamps, known.lamp, known.seen),
          reader_{input.photons.records},
          reflector_light_(input.traced.size(), 0) {
        parallel_for(
            input.traced.size(), [&](size_t i) { reflector_light_[i] = light_of_reflector(input.traced[i]); }, 4096);
    }

    /// Writes the light of the nodes of grid m, smoothed.
    void gather_grid(uint m, std::span<vec3> light) const {
        const SurfaceGrid& grid = in_.lattice.surfaces.grids[m];
        const SurfaceLattice& lattice = grid.lattice;
        const size_t photons = count_photons(grid);
        if (photons == 0 && is_dark(m)) return;
        const float limit = photons > 0 ? limit_of(lattice, photons) : all_light;
        for (uint node = lattice.first_node; node < lattice.first_node + lattice.columns * lattice.rows; ++node) {
            if (!in_.lattice.nodes[node].exists() || in_.lattice.buried[node]) continue;
            light[node] = gathered(m, node, limit);
        }
        smooth_nodes(in_.lattice, m, {.noise = noise_of_rays, .leaves_buried = true}, light);
        fill_buried_nodes(in_.lattice, m, light);
    }

  private:
    struct Look {
        uint rays;
        float limit;  // luminance, lux
    };

    /// The luminance of the irradiance of the surface that reflected a photon; without end where rays find none.
    float light_of_reflector(const Photon& photon) const {
        if (photon.light() != lamp_) return 0;
        if (photon.reflector_side == no_reflector) return all_light;
        const std::optional<vec3> e = light_.irradiance(photon.reflector_side, photon.reflector);
        return e ? luminance(*e) : all_light;
    }

    std::span<const uint> photons_of(const SurfaceGrid& grid) const {
        const std::vector<uint>& starts = in_.photons.records.cell_starts;
        const uint first = starts[grid.first_cell], last = starts[grid.first_cell + grid.columns * grid.rows];
        return std::span(in_.photons.photons).subspan(first, last - first);
    }

    size_t count_photons(const SurfaceGrid& grid) const {
        const std::span<const uint> photons = photons_of(grid);
        return size_t(
            std::count_if(photons.begin(), photons.end(), [&](uint i) { return in_.traced[i].light() == lamp_; }));
    }

    /// Up to which irradiance rays count the light of a surface that they meet: a few times the mean of the patch they
    /// leave, more where few photons know it. One value for a patch: if it rose and fell with the photons of each node,
    /// nodes with more of them would count each for less, and light would be lost.
    float limit_of(const SurfaceLattice& lattice, size_t photons) const {
        return rays_count_up_to * mean_estimate(lattice) * (1 + 4 / std::sqrt(float(photons)));
    }

    /// True when rays from a few nodes of a grid without photons of the lamp find none of its light.
    bool is_dark(uint m) const {
        const SurfaceLattice& lattice = in_.lattice.surfaces.grids[m].lattice;
        std::vector<uint> there;
        for (uint n = lattice.first_node; n < lattice.first_node + lattice.columns * lattice.rows; ++n)
            if (in_.lattice.nodes[n].exists() && !in_.lattice.buried[n]) there.push_back(n);
        for (size_t i = 0; i < probed_nodes && !there.empty(); ++i)
            if (look_around(m, there[(2 * i + 1) * there.size() / (2 * probed_nodes)], {probing_rays, all_light}) !=
                vec3(0))
                return false;
        return true;
    }

    float mean_estimate(const SurfaceLattice& lattice) const {
        float sum = 0, count = 0;
        for (uint n = lattice.first_node; n < lattice.first_node + lattice.columns * lattice.rows; ++n)
            if (in_.lattice.nodes[n].exists()) sum += luminance(estimate_[n]), count += 1;
        return sum / std::max(count, 1.0f);
    }

    /// The light that rays from a node of grid m find, lux.
    vec3 look_around(uint m, uint node, Look look) const {
        const NodePoint& point = in_.lattice.nodes[node];
        const Surface s = surfaces_.surface_at(point.triangle, point.barycentrics);
        const float side = dot(s.geometric_normal, in_.lattice.surfaces.grids[m].normal) < 0 ? -1.0f : 1.0f;
        const vec3 normal = s.geometric_normal * side, origin = in_.caster.offset(s.position, normal);
        const mat3 frame = frame_around(normal);
        Rng rng(in_.seed, 3 + uint64_t(lamp_), node);
        const auto scramble = uint32_t(mix64(in_.seed * 0x10001 + (uint64_t(node) << 14 | lamp_)));
        vec3 sum(0);
        for (uint i = 0; i < look.rays; ++i) {
            const vec3 direction = sample_cosine(sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
            sum += follow({origin, frame * direction, look.limit}, rng);
        }
        return sum / float(look.rays);
    }

    /// pi times the radiance that comes back along a ray, by way of mirrors, glass and smooth metal.
    vec3 follow(GatherRay ray, Rng& rng) const {
        vec3 sum(0), throughput(1), medium(0);
        for (int depth = 0; depth < max_path; ++depth) {
            const std::optional<Hit> hit = in_.caster.nearest(ray.origin, ray.direction);
            if (!hit) break;
            const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
            if (s.flags & material_unlit) break;
            const vec3 absorption = absorption_before(surfaces_, s, ray.direction, medium);
            throughput *= surfaces_.passed_by_medium(absorption, hit->distance);
            const bool ends = reflects_to_all_sides(surfaces_, s), narrow = has_narrow_lobe(s);
            if (ends) sum += throughput * reflected(hit->triangle, s, ray, narrow);
            if (ends && !narrow && s.transmission <= 0) break;
            const auto next = sample_bsdf(surfaces_, s, -ray.direction, Carries::radiance, rng);
            if (!next) break;
            const bool passes =
                (dot(next->direction, s.geometric_normal) > 0) == (dot(ray.direction, s.geometric_normal) > 0);
            if (ends && !next->narrow && !passes) break;  // counted
            throughput *= next->weight;
            ray.direction = next->direction;
            medium = absorption_after(surfaces_, s, ray.direction, medium);
            const float side = dot(ray.direction, s.geometric_normal) > 0 ? 1.0f : -1.0f;
            ray.origin = in_.caster.offset(s.position, s.geometric_normal * side);
        }
        return sum;
    }

    /// pi times the radiance that a surface reflects back along a ray; without that of a narrow lobe, which is
    /// followed.
    vec3 reflected(uint triangle, const Surface& s, const GatherRay& ray, bool without_lobe) const {
        const bool back = dot(s.geometric_normal, ray.direction) > 0;
        const vec3 e = light_.irradiance(2 * triangle + (back ? 1 : 0), s.position).value_or(vec3(0));
        const float brightness = luminance(e), counted = brightness > ray.limit ? ray.limit / brightness : 1.0f;
        const float cosine = std::abs(dot(s.normal, ray.direction));
        return e * counted *
               (without_lobe ? surfaces_.diffuse_albedo_towards(s, cosine) : surfaces_.albedo_towards(s, cosine));
    }

    /// The light of a node: that of rays, and what the photons around it bring that bright surfaces reflected, beyond
    /// what rays count of these. The more photons, the more rays: light that hardly matters gets few.
    vec3 gathered(uint m, uint node, float limit) const {
        const SurfaceGrid& grid = in_.lattice.surfaces.grids[m];
        const vec3 local = node_in_grid(in_.lattice, grid, node);
        const float radius = bandwidth_at_node(reader_, grid, local), r2 = radius * radius;
        vec3 sum(0);
        float photons = 0;
        reader_.visit_photons(grid, local, radius, [&](uint reference, PhotonPlace, float d2) {
            const float brightness = reflector_light_[in_.photons.photons[reference]];
            photons += brightness > 0 ? 1 : 0;
            if (brightness > limit)
                sum += unpack_rgb9e5(in_.photons.records.fluxes[reference]) *
                       (kernel_shape(d2 / r2) * (1 - limit / brightness));
        });
        const float covered = std::max(unpack_coverage(in_.lattice.coverage[node], radius / grid.radius), min_coverage);
        const uint rays = uint(clamp(rays_per_photon * photons, min_rays, max_rays));
        return look_around(m, node, {rays, limit}) +
               sum * (kernel_peak(r2) / (in_.photons.records.flux_scale * covered));
    }

    const GatherInput in_;
    uint lamp_;
    std::span<const vec3> estimate_;
    SurfaceReader surfaces_;
    SeenLight light_;
    GridReader reader_;
    std::vector<float> reflector_light_;  // of each photon; 0 of other lamps
};

}  // namespace

std::vector<vec3> gather_at_nodes(const GatherInput& input, const KnownLight& known, Progress& progress) {
    std::vector<vec3> light(input.lattice.nodes.size(), vec3(0));
    const NodeGather gather(input, known);
    const std::vector<SurfaceGrid>& grids = input.lattice.surfaces.grids;
    parallel_for(grids.size(), [&](size_t m) {
        gather.gather_grid(uint(m), light);
        progress.step(grids[m].lattice.columns * grids[m].lattice.rows);
    });
    return light;
}

}  // namespace lw
