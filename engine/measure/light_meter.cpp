#include "measure/light_meter.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/parallel.h"
#include "base/progress.h"
#include "maps/buried.h"
#include "measure/gathering.h"
#include "measure/placing.h"
#include "shaders/color.h"
#include "trace/sampling.h"

namespace lw {
namespace {

/// Relative bias of the reflected light is taken as this times the mean search radius where rays end, over their
/// length. Measured against the path tracer (docs/measuring.md): 0.7 % in data/apartment.glb with 200,000 photons.
constexpr float bias_of_kernels = 0.0175f;
constexpr float blocked_within = 0.02f;  // m
constexpr int looks_around = 16;  // of 4 rays each: in a corner a quarter of the view is free, which one look may miss
constexpr float narrower = 0.5f;  // second kernel radius for caustics over the first; the difference measures blur

/// Light meter over one scene and map. Thread-safe.
class LightMeter {
  public:
    LightMeter(const Scene& scene, const RayCaster& caster, const PhotonMap& map)
        : scene_(scene),
          caster_(caster),
          map_(map),
          gatherer_(scene, caster, map),
          path_correlation_(correlation_of_paths(scene, map)) {}

    Reading read(const Sensor& sensor, size_t index, const MeterSettings& settings, PhotonShares& shares) const;
    size_t references() const { return map_.places.size(); }

  private:
    static std::vector<float> correlation_of_paths(const Scene& scene, const PhotonMap& map);
    vec3 direct(uint lamp, const Sensor& sensor, uint samples, uint32_t scramble) const;
    void add_repetition(const Sensor& sensor, uint64_t stream, uint r, const MeterSettings& settings,
                        PhotonShares& shares, Reading& reading) const;
    void add_caustic_on(const Sensor& sensor, PhotonShares& shares, Reading& reading) const;
    void finish(const PhotonShares& shares, Reading& reading) const;

    const Scene& scene_;
    const RayCaster& caster_;
    const PhotonMap& map_;
    Gatherer gatherer_;
    std::vector<float> path_correlation_;
};

/// For each lamp: the factor on the variance because photons of one path are not independent. With r photons stored per
/// path, geometrically distributed, the variance of a sum is up to 1 + 2 r times that of as many independent photons,
/// if all photons of a path count equally. A sensor sees some of them: 1 + r is used.
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

/// Direct light of a lamp at a sensor, lux for intensity 1, RGB.
vec3 LightMeter::direct(uint lamp, const Sensor& sensor, uint samples, uint32_t scramble) const {
    if (is_delta(scene_.lights[lamp].type)) samples = 1;
    vec3 sum(0);
    for (uint i = 0; i < samples; ++i) {
        const auto in =
            gatherer_.emitters().arrive(lamp, sensor.position, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
        if (!in) continue;
        const float response = response_to(sensor, in->to_light);
        if (response <= 0) continue;
        const vec3 light = in->radiance * caster_.transmittance(sensor.position, in->position) * response;
        sum += in->pdf > 0 ? light / in->pdf : light;
    }
    return sum / float(samples);
}

/// Adds one of the independent repetitions: quasi-random rays with a scrambling of their own (Owen 1997).
void LightMeter::add_repetition(const Sensor& sensor, uint64_t stream, uint r, const MeterSettings& settings,
                                PhotonShares& shares, Reading& reading) const {
    const size_t count = scene_.lights.size();
    const uint rays = reading.rays / repetitions;
    Rng rng(settings.seed, 1, stream);
    const auto scramble = uint32_t(mix64(settings.seed * 0x10001 + stream));
    std::vector<vec3> sum(count, vec3(0)), ray(count), squares(count, vec3(0));
    for (uint i = 0; i < rays; ++i) {
        const SensedDirection to = sample_direction(sensor, sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble),
                                                    sobol_owen(i, 2, scramble));
        std::fill(ray.begin(), ray.end(), vec3(0));
        GatherRay gathering{vec3(to.lux_per_radiance), ray, shares, rng};
        gatherer_.gather(sensor.position, to.direction, gathering);
        reading.kernel_bias += bias_of_kernels * gathering.spread / float(reading.rays);
        for (uint lamp = 0; lamp < count; ++lamp) {
            sum[lamp] += ray[lamp];
            const ChannelLux lux = gatherer_.file_lux(lamp, ray[lamp]);
            squares[lamp] += lux * lux;
        }
    }
    for (uint lamp = 0; lamp < count; ++lamp) {
        const vec3 reflected = sum[lamp] / float(rays);
        const auto lamp_scramble = uint32_t(mix64(uint64_t(scramble) << 16 | lamp));
        const vec3 all = reflected + direct(lamp, sensor, std::max(rays / 2, 1u), lamp_scramble);
        reading.lamps[lamp] += gatherer_.file_lux(lamp, all) / float(repetitions);
        reading.repeated[r * count + lamp] = gatherer_.file_lux(lamp, all);
        const ChannelLux mean = gatherer_.file_lux(lamp, reflected);
        reading.scatter[lamp] +=
            max(squares[lamp] / float(rays) - mean * mean, vec3(0)) / float(rays * repetitions * repetitions);
    }
}

/// Adds the caustics of points, spots and suns on the surface that a sensor measures. No ray from the sensor finds
/// these lamps, but their photons lie on the surface.
void LightMeter::add_caustic_on(const Sensor& sensor, PhotonShares& shares, Reading& reading) const {
    const SurfaceReader& surfaces = gatherer_.surfaces();
    const MapReader& maps = gatherer_.maps();
    const std::optional<Hit> hit = map_.caustic_grids > 0 ? surface_under(surfaces, caster_, sensor) : std::nullopt;
    if (!hit) return;
    const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
    const bool front = dot(s.geometric_normal, sensor.normal) > 0;
    const uint own = maps.behind_cuts(maps.caustic_grid_of(hit->triangle, front), s.position);
    if (own == no_grid) return;
    const MapReader::GridPlace at = maps.place_on_grid(maps.grid_of(hit->triangle, front), s.position);
    const SurfaceGrid& grid = maps.grid_at(own);
    const vec3 local = position_in_grid(grid, s.position);
    const float wide = maps.caustic_radius(grid, local);
    const size_t lights = scene_.lights.size();
    std::vector<vec3> blurred(lights, vec3(0)), sharp(lights, vec3(0));
    const auto visit = [&](float radius, std::vector<vec3>& lamps, bool counts) {
        const float r2 = radius * radius,
                    peak = kernel_peak(r2) * (1 / map_.flux_scale) / maps.caustic_coverage(at, grid, radius);
        maps.visit_photons(grid, local, radius, [&](uint i, PhotonPlace place, float d2) {
            const uint lamp = light_of(place);
            if (has_surface(scene_.lights[lamp].type)) return;
            const ChannelLux lux =
                gatherer_.file_lux(lamp, unpack_rgb9e5(map_.fluxes[i]) * (peak * kernel_shape(d2 / r2)));
            lamps[lamp] += lux;
            if (counts) shares.add(i, lux * float(reading.rays));
        });
    };
    visit(wide, blurred, true);
    visit(narrower * wide, sharp, false);
    for (size_t lamp = 0; lamp < lights; ++lamp) {
        reading.lamps[lamp] += blurred[lamp];
        for (uint r = 0; r < repetitions; ++r) reading.repeated[r * lights + lamp] += blurred[lamp];
        reading.blur[lamp] = abs(blurred[lamp] - sharp[lamp]) / (1 - narrower * narrower);
    }
}

void LightMeter::finish(const PhotonShares& shares, Reading& reading) const {
    for (const uint reference : shares.touched) {
        const uint lamp = light_of(map_.places[reference]);
        const ChannelLux share = shares.lux[reference] / float(reading.rays);
        reading.by_photons[lamp] += share;
        reading.photon_variance[lamp] += path_correlation_[lamp] * share * share;
    }
    for (ChannelLux& scatter : reading.scatter) scatter = sqrt(scatter);
}

Reading LightMeter::read(const Sensor& asked, size_t index, const MeterSettings& settings, PhotonShares& shares) const {
    const SurfaceReader& surfaces = gatherer_.surfaces();
    const Sensor sensor = lifted(surfaces, caster_, asked);
    const std::vector<ChannelLux> dark(scene_.lights.size(), vec3(0));
    Reading reading{dark, std::vector<ChannelLux>(dark.size() * repetitions, vec3(0)), dark, dark, dark, dark};
    reading.rays = std::max(settings.rays / repetitions, 1u) * repetitions;
    reading.near_border = is_near_border(surfaces, caster_, sensor);
    reading.at_lamp = is_at_lamp(scene_, sensor);
    Rng blocking(settings.seed, 0, index);
    reading.blocked = sensor.response == Response::planar;
    for (int i = 0; i < looks_around && reading.blocked; ++i)
        reading.blocked = is_buried(caster_, sensor.position, sensor.normal, {blocked_within}, blocking);
    for (uint r = 0; r < repetitions; ++r)
        add_repetition(sensor, index * repetitions + r, r, settings, shares, reading);
    add_caustic_on(sensor, shares, reading);
    finish(shares, reading);
    // When all surfaces show their back the sensor may also be in a room whose faces are turned; then there is light.
    reading.blocked = reading.blocked || (is_dark(reading) && is_inside(surfaces, caster_, sensor));
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
            shares.clear();
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
        if (path_of(map.places[i]) == path_caustic && !has_surface(lamp.type)) caustic += lumen;
    }
    return all > 0 ? caustic / all : 0;
}

}  // namespace lw
