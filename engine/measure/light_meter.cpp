#include "measure/light_meter.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/parallel.h"
#include "base/progress.h"
#include "image/tonemap.h"
#include "maps/coverage.h"
#include "maps/estimate.h"
#include "trace/bsdf.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int longest_path = 64;
/// Bias of the reflected light, in radii of the map over the size of the scene: measured against the path tracer
/// (docs/measuring.md), 0.7 % in data/apartment.glb with 200,000 photons.
constexpr float bias_of_kernels = 0.2f;
constexpr float least_used_coverage = 0.75f;
constexpr float height_over_surface = 1e-3f;  // m
constexpr float blocked_within = 0.02f;       // m
constexpr float on_surface_within = 2e-3f;    // m
/// Noise of a narrow lobe is averaged over the rays, so it is widened less than in a picture: widening loses light at
/// grazing angles.
constexpr float narrowest_reflected_roughness = 0.2f;
constexpr float narrowest_direct_roughness = 0.1f;  // a mirror-like coat shows lamps a little widened

/// What each photon brings to the sensor at hand, lux at the file's powers: the spread of the whole sum.
struct PhotonShares {
    explicit PhotonShares(size_t references) : lux(references, 0) {}
    void add(uint reference, float value) {
        if (!(value > 0)) return;
        if (lux[reference] == 0) touched.push_back(reference);
        lux[reference] += value;
    }
    std::vector<float> lux;
    std::vector<uint> touched;
};

/// Which lamps light a surface around by their own samples: all; all but meshes, which its next ray finds; all, but
/// meshes together with the next ray (multiple importance sampling, Veach 1997).
enum class LampChoice { all, without_meshes, with_path };

/// The power heuristic: part of a sample of density `own` where another way has density `other`.
float share_of(float own, float other) { return own * own / (own * own + other * other); }

/// A ray to the surroundings and what it brought so far.
struct Gathering {
    vec3 throughput;           // lux per radiance and RGB
    std::vector<vec3>& lamps;  // lx per unit intensity
    PhotonShares& shares;
    Rng& rng;
};

/// Light meter over one scene and map. Thread-safe.
class LightMeter : public PhotonEstimator {
  public:
    LightMeter(const Scene& scene, const RayCaster& caster, const PhotonMap& map)
        : PhotonEstimator(scene, map, none_, {gather_mode_smooth, 1, 0}),
          scene_(scene),
          caster_(caster),
          emitters_(scene),
          path_correlation_(correlation_of_paths(scene, map)) {}

    Reading read(Sensor sensor, size_t index, const MeterSettings& settings, PhotonShares& shares) const;
    size_t references() const { return map_.places.size(); }

  private:
    static std::vector<float> correlation_of_paths(const Scene& scene, const PhotonMap& map);
    float file_lux(uint lamp, vec3 per_intensity) const {
        return luminance(per_intensity * scene_.lights[lamp].intensity);
    }
    vec3 direct(uint lamp, const Sensor& sensor, uint samples, uint32_t scramble) const;
    bool is_resolved(uint map, vec3 position, vec3 n_geometric) const;
    void gather(vec3 origin, vec3 direction, Gathering& to) const;
    void add_emission(const Surface& s, vec3 to_view, float weight, Gathering& to) const;
    void add_lamps(const Surface& s, vec3 n_geometric, vec3 n, vec3 to_view, LampChoice choice, Gathering& to) const;
    void add_photons(uint map, uint covered_map, Surface s, vec3 n_geometric, vec3 n, vec3 to_view,
                     Gathering& to) const;
    vec3 lifted(const Sensor& sensor) const;
    void add_repetition(const Sensor& sensor, uint64_t stream, uint r, const MeterSettings& settings,
                        PhotonShares& shares, Reading& reading) const;
    void estimate_on_surface(const Sensor& sensor, Reading& reading) const;
    void finish(const PhotonShares& shares, Reading& reading) const;

    static inline const std::vector<vec3> none_;
    const Scene& scene_;
    const RayCaster& caster_;
    Emitters emitters_;
    std::vector<float> path_correlation_;
};

/// Photons of one path are not independent. With r photons stored per path, geometrically distributed, the variance of
/// a sum over paths is up to 1 + 2 r times that of as many independent photons, where all photons of a path count
/// alike; a sensor sees some of them: 1 + r.
std::vector<float> LightMeter::correlation_of_paths(const Scene& scene, const PhotonMap& map) {
    std::vector<double> references(scene.lights.size(), 0);
    for (const PhotonPlace& place : map.places) references[light_of(place)] += 1;
    std::vector<float> correlation;
    const double per_reference = double(map.stored_photons) / std::max<double>(double(map.places.size()), 1);
    for (size_t lamp = 0; lamp < references.size(); ++lamp)
        correlation.push_back(
            float(1 + references[lamp] * per_reference / std::max<double>(double(map.emitted[lamp]), 1)));
    return correlation;
}

/// Lux per unit intensity that a lamp sends straight to a sensor.
vec3 LightMeter::direct(uint lamp, const Sensor& sensor, uint samples, uint32_t scramble) const {
    if (scene_.lights[lamp].type != light_mesh) samples = 1;
    vec3 sum(0);
    for (uint i = 0; i < samples; ++i) {
        const auto in = emitters_.arrive(lamp, sensor.position, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
        if (!in) continue;
        const float response = response_to(sensor, in->to_light);
        if (response <= 0) continue;
        const vec3 light = in->radiance * caster_.transmittance(sensor.position, in->position) * response;
        sum += in->pdf > 0 ? light / in->pdf : light;
    }
    return sum / float(samples);
}

void LightMeter::add_emission(const Surface& s, vec3 to_view, float weight, Gathering& to) const {
    to.lamps[size_t(s.light)] += to.throughput * emitters_.radiance(s, to_view) * weight;
}

/// Light that lamps send to a surface around and it sends on; one point of each emissive mesh when `meshes`.
void LightMeter::add_lamps(const Surface& s, vec3 n_geometric, vec3 n, vec3 to_view, LampChoice choice,
                           Gathering& to) const {
    for (uint lamp = 0; lamp < light_count; ++lamp) {
        if (lights[lamp].type == light_mesh && choice == LampChoice::without_meshes) continue;
        const float u = to.rng.next(), v = to.rng.next();
        const std::optional<Incident> in = emitters_.arrive(lamp, s.position, u, v);
        if (!in || dot(in->to_light, n_geometric) <= 0 || dot(in->to_light, n) <= 0) continue;
        const vec3 f = to.throughput * eval_brdf(s, n, to_view, in->to_light, false) * dot(in->to_light, n);
        if (f.x + f.y + f.z <= 0) continue;
        const vec3 light =
            f * in->radiance * caster_.transmittance(caster_.offset(s.position, n_geometric), in->position);
        float weight = in->pdf > 0 ? 1 / in->pdf : 1.0f;
        if (in->pdf > 0 && choice == LampChoice::with_path)
            weight *= share_of(in->pdf, bsdf_pdf(*this, s, to_view, in->to_light));
        to.lamps[lamp] += light * weight;
    }
}

/// Reflected light of the photons within half the radius of the map: a radius that does not follow the photons leaves
/// their sum unbiased, and noise at one surface point is averaged over the rays. Coverage is that of `covered_map`.
void LightMeter::add_photons(uint map, uint covered_map, Surface s, vec3 n_geometric, vec3 n, vec3 to_view,
                             Gathering& to) const {
    if (map == no_map) return;
    const SurfaceGrid& grid = grid_at(map);
    const vec3 local = position_in_grid(grid, s.position);
    const float radius = 0.5f * grid.radius, r2 = radius * radius;
    const bool is_covered = has_coverage && covered_map != no_map;
    const float covered = is_covered ? coverage_at(place_on(covered_map, s.position), radius) : 1.0f;
    const float peak = 2 / (lw_pi * r2) * inverse_flux_scale / covered;
    const vec3 diffuse = eval_brdf(s, n, to_view, n, true);
    s.roughness = std::max(s.roughness, narrowest_reflected_roughness);
    const ivec2 low = cell_of(local - vec3(radius, radius, 0), grid),
                high = cell_of(local + vec3(radius, radius, 0), grid);
    for (int y = low.y; y <= high.y; ++y) {
        const uvec2 span = row_span(grid, low.x, high.x, y);
        for (uint i = span.x; i < span.y; ++i) {
            const PhotonPlace place = photon_place(i);
            const vec3 d = place_in_grid(place, grid) - local;
            const float d2 = dot(d, d);
            if (d2 >= r2 || !on_same_surface(d.z, d2, max_radius)) continue;
            vec3 f = diffuse;
            if (has_directions) {
                const vec3 from = unpack_direction(photon_direction(i));
                const float tilt = clamp(dot(n, from) / std::max(dot(n_geometric, from), 0.05f), 0.0f, 2.0f);
                f = eval_brdf(s, n, to_view, from, false) * tilt;
            }
            const uint lamp = light_of(place);
            const vec3 light = to.throughput * f * unpack_rgb9e5(photon_flux(i)) * (peak * (1 - d2 / r2));
            to.lamps[lamp] += light;
            to.shares.add(i, file_lux(lamp, light));
        }
    }
}

/// Whether the photons around a point speak for it: they lie on enough surface (the mean of the inverse of a small
/// coverage is too large), and nothing stands between, or light would pass under walls.
bool LightMeter::is_resolved(uint map, vec3 position, vec3 n_geometric) const {
    constexpr int feelers = 6;
    constexpr float reach = 1.2f;  // over cos 30 degrees, so that a wall between two feelers is met
    if (map == no_map) return true;
    const MapPlace at = place_on(map, position);
    const float radius = 0.5f * at.grid.radius;
    if (has_coverage && coverage_at(at, radius) < least_used_coverage) return false;
    const mat3 frame = frame_around(n_geometric);
    const vec3 start = caster_.offset(position, n_geometric);
    for (int i = 0; i < feelers; ++i)
        if (caster_.nearest(start, frame * direction_of(0, float(i) / feelers), reach * radius)) return false;
    return true;
}

/// Follows a ray to the first surface that photons can describe: through glass, over mirrors, and off surfaces that are
/// closer or smaller than the photons resolve (else corners and furniture would be brighter or darker than they are).
void LightMeter::gather(vec3 origin, vec3 direction, Gathering& to) const {
    // Direct light of the sensor is already counted, but not what comes over a mirror or a lens; after a surface that
    // was walked on from, lamps are found by both ways.
    bool emission = false;
    vec3 medium(0);                    // absorption of what the ray goes through, 1/m
    float density = 0, travelled = 0;  // of the last ray's direction, 0 for a mirror; m since it started
    for (int depth = 0; depth < longest_path; ++depth) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction);
        if (!hit) return;
        const Surface s = surface_at(hit->triangle, hit->barycentrics);
        if (s.flags & material_unlit) return;
        const vec3 to_view = -direction;
        travelled += hit->distance;
        to.throughput *= passed_by_medium(absorption_before(*this, s, direction, medium), hit->distance);
        if (emission && s.light >= 0) {
            const float other = density > 0 ? emitters_.arrive_pdf(s, travelled, direction) : 0.0f;
            add_emission(s, to_view, density > 0 ? share_of(density, other) : 1.0f, to);
        }
        const bool front = dot(s.geometric_normal, to_view) >= 0;
        const vec3 n_geometric = front ? s.geometric_normal : -s.geometric_normal;
        vec3 n = front ? s.normal : -s.normal;
        if (dot(n, to_view) <= 1e-4f) n = n_geometric;
        const uint map = map_at(map_of(hit->triangle, front), s.position);
        const bool specular = is_purely_specular(s);
        const bool sharp = !specular && s.metallic > 0.5f && s.roughness < narrowest_gathered_roughness;
        const bool close = hit->distance < 0.5f * max_radius || !is_resolved(map, s.position, n_geometric);
        const bool walk_on = specular || sharp || close;
        Surface lit = s;
        if (!walk_on) lit.roughness = std::max(s.roughness, narrowest_direct_roughness);
        if (!specular && (walk_on || !map_.settings.direct_in_photons))
            add_lamps(lit, n_geometric, n, to_view,
                      sharp     ? LampChoice::without_meshes
                      : walk_on ? LampChoice::with_path
                                : LampChoice::all,
                      to);
        if (!walk_on) add_photons(map, map, s, n_geometric, n, to_view, to);
        if (!walk_on && has_caustics)
            add_photons(map_at(caustic_map_of(hit->triangle, front), s.position), map, s, n_geometric, n, to_view, to);
        if (!walk_on && s.transmission <= 0) return;

        const std::optional<Scatter> next = sample_bsdf(*this, s, to_view, Carries::radiance, to.rng);
        if (!next) return;
        const bool passes = dot(next->direction, n_geometric) < 0;
        if (!walk_on && !passes) return;
        to.throughput *= next->weight;
        if (depth > 3) {
            const float survival =
                std::min(0.95f, std::max({to.throughput.x, to.throughput.y, to.throughput.z}) / lw_pi);
            if (!(to.rng.next() < survival)) return;
            to.throughput /= survival;
        }
        if (!next->straight) emission = true, density = next->specular || sharp ? 0.0f : next->pdf, travelled = 0;
        direction = next->direction;
        medium = absorption_after(*this, s, direction, medium);
        origin = caster_.offset(s.position, passes ? -n_geometric : n_geometric);
    }
}

/// The density of the photons on the surface right behind a sensor, beside its direct light.
void LightMeter::estimate_on_surface(const Sensor& sensor, Reading& reading) const {
    const std::optional<Hit> hit = caster_.nearest(sensor.position, -sensor.normal, on_surface_within);
    if (!hit || sensor.response != Response::planar) return;
    const Surface s = surface_at(hit->triangle, hit->barycentrics);
    const bool front = dot(s.geometric_normal, sensor.normal) > 0;
    if (std::abs(dot(s.geometric_normal, sensor.normal)) < 0.99f) return;
    reading.on_surface = true;
    reading.photon_map.assign(light_count, 0);
    if (!map_.settings.direct_in_photons)
        for (uint lamp = 0; lamp < light_count; ++lamp)
            reading.photon_map[lamp] = file_lux(lamp, reading.lamps[lamp]) - reading.indirect[lamp];
    const uint map = map_at(map_of(hit->triangle, front), s.position);
    if (map == no_map) return;
    const MapPlace at = place_on(map, s.position);
    const SurfaceGrid& grid = at.grid;
    const vec3 local = at.local;
    const float r2 = grid.radius * grid.radius, covered = has_coverage ? coverage_at(at, grid.radius) : 1.0f;
    const vec3 reach(grid.radius, grid.radius, 0);
    const ivec2 low = cell_of(local - reach, grid), high = cell_of(local + reach, grid);
    for (int y = low.y; y <= high.y; ++y) {
        const uvec2 span = row_span(grid, low.x, high.x, y);
        for (uint i = span.x; i < span.y; ++i) {
            const PhotonPlace place = photon_place(i);
            const vec3 d = place_in_grid(place, grid) - local;
            const float d2 = dot(d, d), peak = 2 / (lw_pi * r2) * inverse_flux_scale / covered;
            if (d2 >= r2 || !on_same_surface(d.z, d2, max_radius)) continue;
            const vec3 lux = unpack_rgb9e5(photon_flux(i)) * (peak * (1 - d2 / r2));
            reading.photon_map[light_of(place)] += file_lux(light_of(place), lux);
        }
    }
}

void LightMeter::finish(const PhotonShares& shares, Reading& reading) const {
    double sum = 0, sum2 = 0;
    for (const uint reference : shares.touched) {
        const uint lamp = light_of(photon_place(reference));
        const float share = shares.lux[reference] / float(reading.rays);
        reading.by_photons[lamp] += share;
        reading.photon_variance[lamp] += path_correlation_[lamp] * share * share;
        sum += double(share), sum2 += double(path_correlation_[lamp] * share * share);
    }
    reading.photons = sum2 > 0 ? float(sum * sum / sum2) : 0;
}

/// A sensor that lies on a surface or in a corner, or closer to it than a hair, stands 1 mm off: it neither leaks nor
/// hides. Walls beside it count where they face it; what is behind it counts from either side.
vec3 LightMeter::lifted(const Sensor& sensor) const {
    const mat3 frame = frame_around(sensor.normal);
    vec3 position = sensor.position;
    for (const vec3 away : {frame[2], frame[0], -frame[0], frame[1], -frame[1]}) {
        const vec3 start = position + away * height_over_surface;
        const std::optional<Hit> hit = caster_.nearest(start, -away, 2 * height_over_surface);
        if (!hit) continue;
        const vec3 n = surface_at(hit->triangle, hit->barycentrics).geometric_normal;
        if (away != frame[2] && dot(n, away) < 0.5f) continue;
        position = start + away * (height_over_surface - hit->distance);
    }
    return position;
}

/// One of the independent repetitions: quasi-random rays (Owen 1997) of their own scrambling.
void LightMeter::add_repetition(const Sensor& sensor, uint64_t stream, uint r, const MeterSettings& settings,
                                PhotonShares& shares, Reading& reading) const {
    const size_t count = light_count;
    const uint rays = reading.rays / repetitions;
    Rng rng(settings.seed, 1, stream);
    const auto scramble = uint32_t(mix64(settings.seed * 0x10001 + stream));
    std::vector<vec3> sum(count, vec3(0)), ray(count);
    std::vector<double> squares(count, 0);
    for (uint i = 0; i < rays; ++i) {
        const SensedDirection to = sample_direction(sensor, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble),
                                                    sobol_owen(i, 2, scramble));
        std::fill(ray.begin(), ray.end(), vec3(0));
        Gathering gathering{vec3(to.lux_per_radiance), ray, shares, rng};
        gather(sensor.position, to.direction, gathering);
        for (uint lamp = 0; lamp < count; ++lamp) {
            sum[lamp] += ray[lamp];
            const auto lux = double(file_lux(lamp, ray[lamp]));
            squares[lamp] += lux * lux;
        }
    }
    for (uint lamp = 0; lamp < count; ++lamp) {
        const vec3 reflected = sum[lamp] / float(rays);
        const auto lamp_scramble = uint32_t(mix64(uint64_t(scramble) << 16 | lamp));
        const vec3 all = reflected + direct(lamp, sensor, std::max(rays / 2, 1u), lamp_scramble);
        reading.lamps[lamp] += all / float(repetitions);
        reading.repeated[r * count + lamp] = file_lux(lamp, all);
        reading.indirect[lamp] += file_lux(lamp, reflected) / float(repetitions);
        const double mean = double(file_lux(lamp, reflected));
        const double variance = std::max(squares[lamp] / rays - mean * mean, 0.0) / rays;
        reading.scatter[lamp] += float(variance / (repetitions * repetitions));
    }
}

Reading LightMeter::read(Sensor sensor, size_t index, const MeterSettings& settings, PhotonShares& shares) const {
    Reading reading;
    const size_t count = light_count;
    reading.rays = std::max(settings.rays / repetitions, 1u) * repetitions;
    reading.lamps.assign(count, vec3(0));
    reading.repeated.assign(count * repetitions, 0);
    reading.photon_variance.assign(count, 0);
    reading.scatter.assign(count, 0);
    reading.indirect.assign(count, 0);
    reading.by_photons.assign(count, 0);
    reading.kernel_bias = bias_of_kernels * max_radius / scene_size;
    sensor.position = lifted(sensor);
    Rng blocking(settings.seed, 0, index);
    reading.blocked = sensor.response == Response::planar &&
                      is_buried(caster_, sensor.position, sensor.normal, blocked_within, blocking);
    for (uint r = 0; r < repetitions; ++r)
        add_repetition(sensor, index * repetitions + r, r, settings, shares, reading);
    finish(shares, reading);
    estimate_on_surface(sensor, reading);
    return reading;
}

}  // namespace

std::vector<Reading> read_sensors(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                  std::span<const Sensor> sensors, const MeterSettings& settings) {
    const LightMeter meter(scene, caster, map);
    std::vector<Reading> readings(sensors.size());
    Progress progress("sensors", sensors.size());
    const size_t chunks = std::min<size_t>(sensors.size(), 4 * std::max(1u, std::thread::hardware_concurrency()));
    parallel_for(chunks, [&](size_t chunk) {
        PhotonShares shares(meter.references());
        for (size_t i = chunk; i < sensors.size(); i += chunks) {
            readings[i] = meter.read(sensors[i], i, settings, shares);
            for (const uint reference : shares.touched) shares.lux[reference] = 0;
            shares.touched.clear();
            progress.step();
        }
    });
    return readings;
}

double share_of_caustics(const Scene& scene, const PhotonMap& map) {
    double caustic = 0, all = 0;
    for (size_t i = 0; i < map.places.size(); ++i) {
        const Light& lamp = scene.lights[light_of(map.places[i])];
        const double lumen = double(luminance(unpack_rgb9e5(map.fluxes[i]) * lamp.intensity));
        all += lumen;
        if (path_of(map.places[i]) == path_caustic && lamp.type != light_mesh) caustic += lumen;
    }
    return all > 0 ? caustic / all : 0;
}

}  // namespace lw
