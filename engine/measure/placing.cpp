#include "measure/placing.h"

#include <cmath>

#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float height_over_surface = 1e-3f;  // m
constexpr float on_surface_within = 2e-3f;    // m
constexpr float border_within = 1e-2f;        // m
constexpr int directions_beside = 16;
constexpr float least_alignment = 0.99f;  // cosine between a sensor and the surface it measures

}  // namespace

Sensor lifted(const SurfaceReader& surfaces, const RayCaster& caster, Sensor sensor) {
    const mat3 frame = frame_around(sensor.normal);
    for (const vec3 away : {frame[2], frame[0], -frame[0], frame[1], -frame[1]}) {
        const vec3 start = sensor.position + away * height_over_surface;
        const std::optional<Hit> hit = caster.nearest(start, -away, 2 * height_over_surface);
        if (!hit) continue;
        const vec3 n = surfaces.surface_at(hit->triangle, hit->barycentrics).geometric_normal;
        if (away != frame[2] && dot(n, away) < 0.5f) continue;
        sensor.position = start + away * (height_over_surface - hit->distance);
    }
    return sensor;
}

std::optional<Hit> surface_under(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor) {
    if (sensor.response != Response::planar) return std::nullopt;
    const std::optional<Hit> hit = caster.nearest(sensor.position, -sensor.normal, on_surface_within);
    if (!hit) return std::nullopt;
    const vec3 n = surfaces.surface_at(hit->triangle, hit->barycentrics).geometric_normal;
    return std::abs(dot(n, sensor.normal)) < least_alignment ? std::nullopt : hit;
}

bool is_inside(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor) {
    const mat3 frame = frame_around(sensor.normal);
    for (int i = 0; i < directions_beside; ++i) {
        const vec3 direction = frame * direction_of(float(i + 1) / (directions_beside + 1), 0.618f * float(i));
        const std::optional<Hit> hit = caster.nearest(sensor.position, direction);
        if (!hit || dot(surfaces.surface_at(hit->triangle, hit->barycentrics).geometric_normal, direction) < 0)
            return false;
    }
    return true;
}

bool is_near_border(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor) {
    if (sensor.response != Response::planar) return false;
    const bool lies = surface_under(surfaces, caster, sensor).has_value();
    const mat3 frame = frame_around(sensor.normal);
    for (int i = 0; i < directions_beside; ++i) {
        const vec3 beside = frame * direction_of(0, float(i) / directions_beside);
        if (caster.nearest(sensor.position, beside, border_within)) return true;
        const vec3 above = sensor.position + beside * border_within;
        if (lies && !caster.nearest(above, -sensor.normal, on_surface_within + 0.2f * border_within)) return true;
    }
    return false;
}

}  // namespace lw
