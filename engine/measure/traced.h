// Reference illuminance at sensors, by the path tracer, which shares scene and lamps with the photons but none of their
// estimators. Caustics of points and suns are traced from the lamps, as lumenwalk-reference does.
#pragma once
#include <span>
#include <vector>

#include "daylight/daylight.h"
#include "measure/sensor.h"
#include "trace/ray_caster.h"

namespace lw {

/// Mean of many paths and its standard error, lx.
struct Traced {
    double lux = 0;
    double standard_error = 0;
};

struct TraceSettings {
    uint64_t paths = 10'000;  // per sensor
    uint64_t seed = 1;
    const Daylight* daylight = nullptr;  // around the scene; nullptr: darkness
};

/// Path traces the illuminance at each sensor. `powers`: RGB power of each lamp (lamp_powers()). Sensors that lie on
/// surfaces are moved 1 mm off them, as in read_sensors().
std::vector<Traced> trace_sensors(const Scene& scene, const RayCaster& caster, const std::vector<vec3>& powers,
                                  std::span<const Sensor> sensors, const TraceSettings& settings);

}  // namespace lw
