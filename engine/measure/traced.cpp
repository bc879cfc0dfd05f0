#include "measure/traced.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "measure/placing.h"
#include "shaders/color.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint64_t sets_of_caustics = 16;
constexpr uint64_t paths_per_set = 200'000;
constexpr float caustic_radius = 2e-3f;  // of the scene's size: the kernel radius of the first set of caustics

/// Sum and squares of samples.
struct Sum {
    double value = 0, squares = 0;
    void add(double sample) { value += sample, squares += sample * sample; }
    Traced over(uint64_t count) const {
        const double n = double(count), mean = value / n;
        return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
    }
};

/// The illuminance by one path. A cylindrical receiver is the mean over all planes that contain its axis, so each path
/// takes one of them.
double sample_at(const PathTracer& tracer, const Sensor& sensor, vec3 place, const Caustics* caustics, Rng& rng) {
    if (sensor.response == Response::planar)
        return double(luminance(tracer.irradiance(place, sensor.normal, rng, caustics)));
    const vec3 normal = frame_around(sensor.normal) * direction_of(0, rng.next());
    return double(luminance(tracer.irradiance(place, normal, rng)));
}

}  // namespace

std::vector<Traced> trace_sensors(const Scene& scene, const RayCaster& caster, const std::vector<vec3>& powers,
                                  std::span<const Sensor> sensors, const TraceSettings& settings) {
    const std::optional<SkySampler> around = sky_around(scene, settings.daylight);
    const SkySampler* sky = around ? &*around : nullptr;
    const PathTracer tracer(scene, caster, powers, sky);
    const SurfaceReader surfaces(scene);
    const bool with_caustics = has_caustics(scene, powers, sky);
    const uint64_t sets = with_caustics ? sets_of_caustics : 1;
    const uint64_t paths = std::max<uint64_t>((settings.paths + sets - 1) / sets, 1);
    std::vector<Sum> sums(sensors.size()), of_sets(sensors.size());
    Progress progress("reference", sets * sensors.size());
    for (uint64_t set = 0; set < sets; ++set) {
        std::optional<Caustics> caustics;
        if (with_caustics) {
            const float radius = caustic_radius * scene.size() / std::sqrt(float(set + 1));
            caustics.emplace(scene, caster, powers, CausticSettings{paths_per_set, radius, settings.seed, set, sky});
        }
        parallel_for(sensors.size(), [&](size_t i) {
            const Sensor sensor = lifted(surfaces, caster, sensors[i]);
            Sum own;
            for (uint64_t n = 0; n < paths; ++n) {
                Rng rng(settings.seed ^ 0x7ace, i, set * paths + n);
                own.add(sample_at(tracer, sensor, sensor.position, caustics ? &*caustics : nullptr, rng));
            }
            sums[i].value += own.value, sums[i].squares += own.squares;
            of_sets[i].add(own.value / double(paths));
            progress.step();
        });
    }
    std::vector<Traced> traced;
    for (size_t i = 0; i < sensors.size(); ++i) {
        traced.push_back(sums[i].over(sets * paths));
        // Paths of a set share its caustics: then only the sets are independent.
        if (sets > 1) traced.back().standard_error = of_sets[i].over(sets).standard_error * std::sqrt(16.0 / 15);
    }
    return traced;
}

}  // namespace lw
