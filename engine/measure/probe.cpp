#include "measure/probe.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "maps/estimate.h"
#include "maps/map_reader.h"
#include "shaders/color.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint photons_per_estimate = 300;
constexpr uint shadow_rays = 64;             // to a mesh lamp, of the luminance
constexpr float narrower[] = {0.7f, 0.35f};  // other bandwidths, as parts of the first
constexpr uint batches = 8;                  // of rays to a mesh lamp, scrambled apart: their spread is the error
constexpr uint rays_per_batch = 16;
constexpr uint max_tile_paths = 16;
constexpr float normal_90 = 1.645f;       // 90 % of a normal distribution lies within
constexpr float relative_floor = 0.005f;  // packing of the records: RGB9E5 and 16-bit places

/// A sum of independent parts and the sum of their squares.
struct Sum {
    float value = 0;
    float squares = 0;
};

}  // namespace

struct Probe::Parts {
    const Scene& scene;
    const RayCaster& caster;
    const PhotonMap& map;
    MapReader maps;
    Emitters emitters;
    PhotonEstimator unlit;  // what the viewer sees, once the lamps have powers
    bool has_direct;
};

namespace {

/// Reads with the lamps at given powers.
class Meter {
  public:
    Meter(const Probe::Parts& parts, const std::vector<vec3>& powers)
        : parts_(parts),
          scene_(parts.scene),
          map_(parts.map),
          maps_(parts.maps),
          estimator_(parts.unlit.with_powers(powers)),
          powers_(powers) {}

    Measurement measure_at(const Hit& hit, vec3 viewer) const {
        const Surface s = estimator_.surface_at(hit.triangle, hit.barycentrics);
        const bool front = dot(s.geometric_normal, viewer - s.position) >= 0;
        Measurement m;
        m.position = s.position;
        m.normal = front ? s.geometric_normal : -s.geometric_normal;
        m.triangle = hit.triangle;
        m.lamps.resize(scene_.lights.size());
        float variance = 0;
        const MapReader::GridPlace place = maps_.place_on_grid(maps_.grid_of(hit.triangle, front), s.position);
        if (place.index != no_grid) variance += add_reflected(place.grid, place, false, m);
        if (map_.caustic_grids > 0)
            if (const uint own = maps_.behind_cuts(maps_.caustic_grid_of(hit.triangle, front), s.position);
                own != no_grid)
                variance += add_reflected(maps_.grid_at(own), place, true, m);
        if (parts_.has_direct)
            for (uint lamp = 0; lamp < scene_.lights.size(); ++lamp) variance += add_direct(lamp, m);
        for (const LampShare& share : m.lamps) m.lux += share.lux;
        m.half_width_lux = normal_90 * std::sqrt(variance + relative_floor * relative_floor * m.lux * m.lux);
        m.luminance = luminance_of(hit, viewer);
        return m;
    }

  private:
    /// Towards the viewer; mean over the paths of a tile of pixels, as those along lobes meet different surfaces.
    float luminance_of(const Hit& hit, vec3 viewer) const {
        const PhotonEstimator::Seen seen = estimator_.see(hit.triangle, hit.barycentrics, viewer);
        const bool goes_on = estimator_.goes_on(seen, branch_reflected) || estimator_.goes_on(seen, branch_through);
        const uint paths = goes_on ? max_tile_paths : 1;
        float sum = 0;
        for (uint i = 0; i < paths; ++i)
            sum += luminance(
                estimator_.shade(hit.triangle, hit.barycentrics, viewer, 1 + i, uvec2(i / 4, i % 4)).radiance);
        return sum / float(paths);
    }

    /// Photons within `radius`, of which `covered` lies on surface; per lamp when `shares` is not null.
    Sum add_photons(const SurfaceGrid& grid, vec3 local, float covered, float radius, Measurement* shares) const {
        const float r2 = radius * radius;
        const float share = kernel_peak(r2) * (1 / map_.flux_scale) / covered;
        Sum sum;
        maps_.visit_photons(grid, local, radius, [&](uint i, PhotonPlace photon, float d2) {
            const uint lamp = light_of(photon);
            const float lux =
                luminance(unpack_rgb9e5(map_.fluxes[i]) * powers_[lamp]) * (share * kernel_shape(d2 / r2));
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
    float add_reflected(const SurfaceGrid& grid, const MapReader::GridPlace& place, bool caustic,
                        Measurement& m) const {
        const vec3 local = position_in_grid(grid, m.position);
        const float bandwidth = caustic ? maps_.caustic_radius(grid, local) : maps_.bandwidth_from_counts(grid, local);
        if (m.bandwidth <= 0) m.bandwidth = bandwidth;
        const auto covered = [&](float radius) {
            return caustic ? maps_.caustic_coverage(place, grid, radius) : maps_.covered_part(place, radius);
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
        const auto in = parts_.emitters.arrive(lamp, m.position, u, v);
        const float cosine = in ? dot(in->to_light, m.normal) : 0.0f;
        if (cosine <= 0) return 0;
        const vec3 passed = parts_.caster.transmittance(parts_.caster.offset(m.position, m.normal), in->position);
        return luminance(in->radiance * passed * powers_[lamp]) * cosine / (in->pdf > 0 ? in->pdf : 1.0f);
    }

    float add_direct(uint lamp, Measurement& m) const {
        Sum sum;
        const bool mesh = scene_.lights[lamp].type == light_mesh;
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

    const Probe::Parts& parts_;
    const Scene& scene_;
    const PhotonMap& map_;
    const MapReader& maps_;
    PhotonEstimator estimator_;
    const std::vector<vec3>& powers_;
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

Probe::Probe(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const Bvh& bvh) {
    static const std::vector<vec3> no_powers;
    const GatherSettings settings{
        .mode = gather_mode_smooth, .neighbours = photons_per_estimate, .shadow_rays = shadow_rays};
    parts_ = std::make_unique<const Parts>(Parts{.scene = scene,
                                                 .caster = caster,
                                                 .map = map,
                                                 .maps = MapReader(map, photons_per_estimate),
                                                 .emitters = Emitters(scene),
                                                 .unlit = PhotonEstimator(scene, map, no_powers, settings, bvh),
                                                 .has_direct = !bvh.nodes.empty() && !map.settings.direct_in_photons});
}

Probe::~Probe() = default;

Measurement Probe::measure(const std::vector<vec3>& powers, const SeenPlace& place) const {
    return Meter(*parts_, powers).measure_at(place.hit, place.viewer);
}

std::vector<Measurement> Probe::measure(const std::vector<vec3>& powers, std::span<const SeenPlace> places) const {
    const Meter meter(*parts_, powers);
    std::vector<Measurement> measurements(places.size());
    parallel_for(places.size(), [&](size_t i) { measurements[i] = meter.measure_at(places[i].hit, places[i].viewer); });
    return measurements;
}

}  // namespace lw
