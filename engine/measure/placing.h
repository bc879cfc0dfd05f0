// Moves sensors off the surfaces they lie on, and tells what is close to them.
#pragma once
#include <optional>

#include "measure/sensor.h"
#include "scene/surface.h"
#include "trace/ray_caster.h"

namespace lw {

/// The sensor moved 1 mm off every surface that it lies on or is closer to. So it neither sees through a wall nor is
/// hidden in one. Walls beside the sensor count only when their front faces it; the surface behind it counts from
/// either side.
Sensor lifted(const SurfaceReader& surfaces, const RayCaster& caster, Sensor sensor);

/// The surface that a planar sensor measures: the one parallel to it within 2 mm behind it, if any.
std::optional<Hit> surface_under(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True when a sensor is inside a solid object: all surfaces around show it their back.
bool is_inside(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True when within 1 cm beside a planar sensor a wall stands or the measured surface ends. A real light meter is as
/// large, and models are hardly more exact.
bool is_near_border(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True when a point or spot lamp is within 1 cm. The illuminance of a point grows without bound there, that of a real
/// lamp does not.
bool is_at_lamp(const Scene& scene, const Sensor& sensor);

}  // namespace lw
