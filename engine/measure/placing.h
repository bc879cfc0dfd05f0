// Where a sensor really stands: off the surface it is said to lie on, and how close to what.
#pragma once
#include <optional>

#include "measure/sensor.h"
#include "scene/surface.h"
#include "trace/ray_caster.h"

namespace lw {

/// The sensor 1 mm off any surface that it lies on, in a corner of, or closer to than that: it neither leaks nor hides.
/// Walls beside it count where they face it; what is behind it counts from either side.
Sensor lifted(const SurfaceReader& surfaces, const RayCaster& caster, Sensor sensor);

/// The surface that a planar sensor measures: within 2 mm behind it and parallel to it.
std::optional<Hit> surface_under(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True when a sensor stands in a solid object: all around it looks at back sides.
bool is_inside(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True when a wall stands, or the surface it measures ends, within 1 cm beside a planar sensor: a light meter's head
/// is as large, and models are hardly more exact.
bool is_near_border(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor);

/// True within 1 cm of a lamp that is a point, whose illuminance grows there beyond all bounds and that of the real
/// lamp does not.
bool is_at_lamp(const Scene& scene, const Sensor& sensor);

}  // namespace lw
