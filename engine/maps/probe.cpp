#include "maps/probe.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint photons_per_estimate = 300;
constexpr float narrower[] = {0.7f, 0.35f};  // other bandwidths, as parts of the first
constexpr uint batches = 8;                  // of rays to a mesh lamp, scrambled apart: their spread is the error
constexpr uint rays_per_batch = 16;
constexpr uint max_tile_paths = 16;
constexpr float normal_90 = 1.645f;       // 90 % of a normal distribution lies within
constexpr float relative_floor = 0.005f;  // packing of the records: RGB9E5 and 16-bit places

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f)); }

/// A sum of independent parts and the sum of their squares.
struct Sum {
    float value = 0;
    float squares = 0;
};

class Meter : public PhotonEstimator {
  public:
    Meter(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const Bvh& bvh,
          const std::vector<vec3>& powers)
        : PhotonEstimator(scene, map, powers, {gather_mode_smooth, photons_per_estimate, 64}, bvh),
          caster_(caster),
          emitters_(scene) {}

    Measurement measure_at(const Hit& hit, vec3 viewer) const {
        const Surface s = surface_at(hit.triangle, hit.barycentrics);
        const bool front = dot(s.geometric_normal, viewer - s.position) >= 0;
        Measurement m;
        m.position = s.position;
        m.normal = front ? s.geometric_normal : -s.geometric_normal;
        m.triangle = hit.triangle;
        m.lamps.resize(light_count);
        float variance = 0;
        const MapPlace place = place_on(map_of(hit.triangle, front), s.position);
        if (place.map != no_map) variance += add_reflected(place.grid, place, false, m);
        if (has_caustics)
            if (const uint caustics = map_at(caustic_map_of(hit.triangle, front), s.position); caustics != no_map)
                variance += add_reflected(grid_at(caustics), place, true, m);
        if (has_direct)
            for (uint lamp = 0; lamp < light_count; ++lamp) variance += add_direct(lamp, m);
        for (const LampShare& share : m.lamps) m.lux += share.lux;
        m.half_width_lux = normal_90 * std::sqrt(variance + relative_floor * relative_floor * m.lux * m.lux);
        m.luminance = luminance_of(hit, viewer);
        return m;
    }

  private:
    /// Towards the viewer; mean over the paths of a tile of pixels, as those along lobes meet different surfaces.
    float luminance_of(const Hit& hit, vec3 viewer) const {
        const Seen seen = see(hit.triangle, hit.barycentrics, viewer);
        const uint paths = goes_on(seen, branch_reflected) || goes_on(seen, branch_through) ? max_tile_paths : 1;
        float sum = 0;
        for (uint i = 0; i < paths; ++i)
            sum += luminance(shade(hit.triangle, hit.barycentrics, viewer, 1 + i, uvec2(i / 4, i % 4)).radiance);
        return sum / float(paths);
    }

    /// Photons within `radius`, of which `covered` lies on surface; per lamp when `shares` is not null.
    Sum add_photons(const SurfaceGrid& grid, vec3 local, float covered, float radius, Measurement* shares) const {
        const float r2 = radius * radius;
        const float share = 2 / (lw_pi * r2) * inverse_flux_scale / covered;
        Sum sum;
        visit_photons(grid, local, radius, [&](uint i, PhotonPlace photon, float d2) {
            const uint lamp = light_of(photon);
            const float lux = luminance(unpack_rgb9e5(photon_flux(i)) * lamp_power(lamp)) * (share * (1 - d2 / r2));
            sum.value += lux;
            sum.squares += lux * lux;
            if (!shares) return;
            shares->photons += 1;
            shares->lamps[lamp].lux += lux;
            if (path_of(photon) == path_direct) shares->lamps[lamp].direct_lux += lux;
        });
        return sum;
    }

    /// Returns the variance with the square of the bias, which grows as the square of the bandwidth: what narrower
    /// kernels read differently, less what noise alone makes different.
    float add_reflected(const SurfaceGrid& grid, const MapPlace& place, bool caustic, Measurement& m) const {
        const vec3 local = position_in_grid(grid, m.position);
        const float bandwidth = caustic ? caustic_radius(grid, local) : bandwidth_from_counts(grid, local);
        if (m.bandwidth <= 0) m.bandwidth = bandwidth;
        const auto covered = [&](float radius) {
            if (caustic) return caustic_coverage(place, grid, radius);
            return has_coverage ? coverage_at(place, radius) : 1.0f;
        };
        const Sum wide = add_photons(grid, local, covered(bandwidth), bandwidth, &m);
        float bias2 = 0;
        for (float part : narrower) {
            const float radius = part * bandwidth;
            const Sum thin = add_photons(grid, local, covered(radius), radius, nullptr);
            const float change = wide.value - thin.value, noise2 = std::max(thin.squares - wide.squares, 0.0f);
            const float grows = 1 - part * part;
            bias2 = std::max(bias2, (change * change - noise2) / (grows * grows));
        }
        return wide.squares + bias2;
    }

    /// Light of one sample of a lamp on the plane, lux at full weight.
    float arriving(uint lamp, const Measurement& m, float u, float v) const {
        const auto in = emitters_.arrive(lamp, m.position, u, v);
        const float cosine = in ? dot(in->to_light, m.normal) : 0.0f;
        if (cosine <= 0) return 0;
        const vec3 passed = caster_.transmittance(caster_.offset(m.position, m.normal), in->position);
        return luminance(in->radiance * passed * lamp_power(lamp)) * cosine / (in->pdf > 0 ? in->pdf : 1.0f);
    }

    float add_direct(uint lamp, Measurement& m) const {
        Sum sum;
        const bool mesh = lights[lamp].type == light_mesh;
        for (uint b = 0; b < (mesh ? batches : 1u); ++b) {
            const auto scramble = uint32_t(mix64(uint64_t(lamp) << 8 | b));
            float mean = 0;
            for (uint i = 0; i < (mesh ? rays_per_batch : 1u); ++i)
                mean += arriving(lamp, m, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
            if (mesh) mean /= float(rays_per_batch);
            sum.value += mean;
            sum.squares += mean * mean;
        }
        const float count = mesh ? float(batches) : 1.0f, lux = sum.value / count;
        m.lamps[lamp].lux += lux;
        m.lamps[lamp].direct_lux += lux;
        return mesh ? std::max(sum.squares / count - lux * lux, 0.0f) / (count - 1) : 0.0f;
    }

    const RayCaster& caster_;
    Emitters emitters_;
};

}  // namespace

std::optional<Hit> seen_from(const Scene& scene, const RayCaster& caster, vec3 origin, vec3 direction) {
    const SurfaceReader surfaces(scene);
    float passed = 0;
    for (int layers = 0; layers < 256; ++layers) {
        std::optional<Hit> hit = caster.nearest(origin + direction * passed, direction);
        if (!hit) return std::nullopt;
        hit->distance += passed;
        if (!surfaces.is_see_through(hit->triangle, hit->barycentrics)) return hit;
        passed = hit->distance + caster.epsilon();
    }
    return std::nullopt;
}

Measurement measure(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const Bvh& bvh,
                    const std::vector<vec3>& powers, const Hit& hit, vec3 viewer) {
    return Meter(scene, caster, map, bvh, powers).measure_at(hit, viewer);
}

std::vector<Measurement> measure(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const Bvh& bvh,
                                 const std::vector<vec3>& powers, std::span<const SeenPlace> places) {
    const Meter meter(scene, caster, map, bvh, powers);
    std::vector<Measurement> measurements(places.size());
    parallel_for(places.size(), [&](size_t i) { measurements[i] = meter.measure_at(places[i].hit, places[i].viewer); });
    return measurements;
}

}  // namespace lw
