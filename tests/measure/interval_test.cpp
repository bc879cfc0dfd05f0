// The 90 % interval of a sensor covers the reference path tracer in 85 to 95 % of the cases, in the air and on
// surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/parallel.h"
#include "image/tonemap.h"
#include "maps/build.h"
#include "measure/light_meter.h"
#include "photons/shoot.h"
#include "scene/gltf.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

/// Points in the open air of a scene looking anywhere, and every other one on a surface, 1 mm above it.
std::vector<Sensor> random_sensors(const Scene& scene, const RayCaster& caster, size_t count) {
    const SurfaceReader surfaces(scene);
    std::vector<Sensor> sensors;
    for (uint64_t i = 0; sensors.size() < count && i < 100 * count; ++i) {
        Rng rng(7, 3, i);
        const vec3 share(rng.next(), rng.next(), rng.next());
        Sensor sensor{mix(scene.bounds[0], scene.bounds[1], share), vec3(0), Response::planar};
        sensor.normal = direction_of(1 - 2 * rng.next(), rng.next());
        const auto below = caster.nearest(sensor.position, vec3(0, -1, 0)),
                   above = caster.nearest(sensor.position, vec3(0, 1, 0));
        if (!below || !above) continue;
        if (surfaces.surface_at(below->triangle, below->barycentrics).geometric_normal.y < 0.5f) continue;
        if (surfaces.surface_at(above->triangle, above->barycentrics).geometric_normal.y > -0.5f) continue;
        if (sensors.size() % 2 == 1) {
            const auto hit = caster.nearest(sensor.position, sensor.normal);
            if (!hit) continue;
            const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
            const vec3 n = dot(s.geometric_normal, sensor.normal) > 0 ? -s.geometric_normal : s.geometric_normal;
            sensor.position = s.position + n * 1e-3f;
            sensor.normal = n;
        }
        sensors.push_back(sensor);
    }
    return sensors;
}

struct Truth {
    double lux = 0, error = 0;
};

Truth true_illuminance(const PathTracer& tracer, const Sensor& sensor, uint64_t stream, uint samples) {
    double sum = 0, sum2 = 0;
    for (uint i = 0; i < samples; ++i) {
        Rng rng(99, stream, i);
        const double lux = double(luminance(tracer.irradiance(sensor.position, sensor.normal, rng)));
        sum += lux, sum2 += lux * lux;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(sum2 / samples - mean * mean, 0.0) / samples)};
}

struct Case {
    const char* scene;
    uint64_t photons;
    uint rays;
    size_t sensors;
    uint truth_samples;
    int bakes;
};

void study(const Case& c) {
    const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/" + std::string(c.scene));
    const RayCaster caster(scene);
    const std::vector<Sensor> sensors = random_sensors(scene, caster, c.sensors);
    const PathTracer tracer(scene, caster, light_weights(scene, {}));
    std::vector<Truth> truth(sensors.size());
    parallel_for(truth.size(), [&](size_t i) { truth[i] = true_illuminance(tracer, sensors[i], i, c.truth_samples); });
    const std::vector<float> full(scene.lights.size(), 1.0f);
    std::vector<Value> first;
    for (int bake = 0; bake < c.bakes; ++bake) {
        const auto seed = uint64_t(bake + 1);
        const PhotonMap map =
            build_photon_map(scene, caster, shoot_photons(scene, caster, {c.photons, seed}), {c.photons, 0, 60, seed});
        const std::vector<Reading> readings = read_sensors(scene, caster, map, sensors, {c.rays, seed});
        size_t covered[2] = {0, 0}, count[2] = {0, 0};
        double z_sum[2] = {0, 0}, z2[2] = {0, 0}, bias[2] = {0, 0}, width[2] = {0, 0}, ray[2] = {0, 0},
               photon[2] = {0, 0}, te[2] = {0, 0};
        for (size_t i = 0; i < sensors.size(); ++i) {
            const Value v = value_of(readings[i], scene, full);
            if (truth[i].lux < 1 || !v.doubt.empty()) continue;
            const size_t k = i % 2;
            const double z = (v.lux - truth[i].lux) / v.half_width * 1.645;
            ++count[k];
            covered[k] += std::abs(v.lux - truth[i].lux) <= v.half_width;
            z_sum[k] += z, z2[k] += z * z, bias[k] += v.lux / truth[i].lux - 1, width[k] += v.relative();
            ray[k] += v.ray_error / v.lux, photon[k] += v.photon_error / v.lux, te[k] += truth[i].error / truth[i].lux;
            if (std::getenv("LW_LIST") && std::abs(z) > 3)
                std::printf(
                    "   %zu (%.2f %.2f %.2f) n(%.2f %.2f %.2f): %.1f +- %.1f  truth %.1f +- %.1f ind %.1f ray %.2f ph "
                    "%.2f\n",
                    i, double(sensors[i].position.x), double(sensors[i].position.y), double(sensors[i].position.z),
                    double(sensors[i].normal.x), double(sensors[i].normal.y), double(sensors[i].normal.z), v.lux,
                    v.half_width, truth[i].lux, truth[i].error, v.lux, v.ray_error, v.photon_error);
        }
        for (int k = 0; k < 2; ++k) {
            const double n = double(count[k]);
            std::printf(
                "%-14s %8llu photons %5u rays bake %d %-7s: %3zu of %3zu covered %.3f, z mean %+.2f rms %.2f, bias "
                "%+.2f %%, half width %.2f %%, rays %.2f photons %.2f truth %.2f\n",
                c.scene, (unsigned long long)c.photons, c.rays, bake, k ? "surface" : "air", covered[k], count[k],
                double(covered[k]) / n, z_sum[k] / n, std::sqrt(z2[k] / n), 100 * bias[k] / n, 100 * width[k] / n,
                100 * ray[k] / n, 100 * photon[k] / n, 100 * te[k] / n);
        }
        // spread between bakes, of the photons alone
    }
}

TEST(Study, Interval) {
    const uint rays = uint(std::atoi(std::getenv("LW_RAYS") ? std::getenv("LW_RAYS") : "512"));
    const uint truth = uint(std::atoi(std::getenv("LW_TRUTH") ? std::getenv("LW_TRUTH") : "8192"));
    const uint64_t photons = uint64_t(std::atoi(std::getenv("LW_PHOTONS") ? std::getenv("LW_PHOTONS") : "200000"));
    const size_t sensors = size_t(std::atoi(std::getenv("LW_SENSORS") ? std::getenv("LW_SENSORS") : "200"));
    const int bakes = std::atoi(std::getenv("LW_BAKES") ? std::getenv("LW_BAKES") : "2");
    study({std::getenv("LW_SCENE") ? std::getenv("LW_SCENE") : "cornell.gltf", photons, rays, sensors, truth, bakes});
}

}  // namespace
}  // namespace lw
