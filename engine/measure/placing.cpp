#include "measure/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float height_over_surface = 1e-3f;  // m
constexpr float tolerance = 0.05f;            // of the height
constexpr float on_surface_within = 2e-3f;    // m
constexpr float border_within = 1e-2f;        // m
constexpr float lamp_within = 1e-2f;          // m
constexpr int directions_beside = 16;
constexpr float min_alignment = 0.99f;  // cosine between a sensor and the surface it measures
constexpr float facing = 0.5f;          // least cosine between a sensor and a surface that counts as behind it
constexpr size_t max_around = 256;      // most triangles that are looked at within a millimetre
constexpr int pushes = 8;  // rounds of moving out of a corner: each wall moves the sensor a little towards the others

/// A triangle close to a sensor. Its normal points to the side on which the sensor must be.
struct Facet {
    std::array<vec3, 3> corners;
    vec3 normal;
    bool is_measured;

    float height(vec3 p) const { return dot(p - corners[0], normal); }
    float distance(vec3 p) const {
        return length(p - closest_point_on_triangle(p, corners[0], corners[1], corners[2]));
    }
    vec3 pushed(vec3 p) const { return p + normal * (height_over_surface - height(p)); }
};

/// The triangles within 1 mm of a sensor: those it measures first, then by distance. The normal of a measured triangle
/// is turned to the sensor's direction, as is that of one behind a sensor that measures none. For other triangles the
/// front counts, or for double-sided ones the side on which the sensor is.
std::vector<Facet> facets_around(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor) {
    std::vector<uint> found;
    caster.triangles_around(sensor.position, height_over_surface, max_around, found);
    std::sort(found.begin(), found.end());
    std::vector<Facet> facets;
    for (const uint t : found) {
        const std::array<vec3, 3> p{surfaces.corner_position(t, 0), surfaces.corner_position(t, 1),
                                    surfaces.corner_position(t, 2)};
        const vec3 product = edge_product(p[0], p[1], p[2]);
        if (!(length(product) > 0)) continue;
        const vec3 n = product / length(product);
        facets.push_back({p, n, std::abs(dot(n, sensor.normal)) >= min_alignment});
        const bool is_sheet = surfaces.material_of(t).flags & material_double_sided;
        if (is_sheet && facets.back().height(sensor.position) < -tolerance * height_over_surface)
            facets.back().normal = -n;
    }
    const bool lies = std::any_of(facets.begin(), facets.end(), [](const Facet& f) { return f.is_measured; });
    for (Facet& f : facets)
        if (const float cosine = dot(f.normal, sensor.normal); f.is_measured || (!lies && std::abs(cosine) >= facing))
            f.normal *= cosine < 0 ? -1.0f : 1.0f;
    std::stable_sort(facets.begin(), facets.end(), [&](const Facet& a, const Facet& b) {
        return std::tuple(!a.is_measured, a.distance(sensor.position)) <
               std::tuple(!b.is_measured, b.distance(sensor.position));
    });
    return facets;
}

/// Chooses the triangles from which the sensor is moved. Of two back to back the nearer is kept. A wall whose front is
/// turned away from the measured surface is turned round.
std::vector<Facet> sides_of(const std::vector<Facet>& facets, vec3 position) {
    const auto is_over_measured = [&](vec3 p) {
        return std::any_of(facets.begin(), facets.end(), [&](const Facet& f) {
            return f.is_measured && f.distance(p) <= (1 + tolerance) * height_over_surface;
        });
    };
    std::vector<Facet> sides;
    for (Facet f : facets) {
        if (f.is_measured) {
            if (f.height(position) < height_over_surface) position = f.pushed(position);
        } else if (!is_over_measured(f.pushed(position))) {
            f.normal = -f.normal;
            if (!is_over_measured(f.pushed(position))) f.normal = -f.normal;
        }
        const auto is_opposite = [&](const Facet& other) { return dot(other.normal, f.normal) < -facing; };
        if (std::none_of(sides.begin(), sides.end(), is_opposite)) sides.push_back(f);
    }
    return sides;
}

}  // namespace

Sensor lifted(const SurfaceReader& surfaces, const RayCaster& caster, Sensor sensor) {
    const std::vector<Facet> sides = sides_of(facets_around(surfaces, caster, sensor), sensor.position);
    for (int i = 0; i < pushes; ++i)
        for (const Facet& f : sides)
            if (f.distance(sensor.position) < (1 - tolerance) * height_over_surface)
                sensor.position = f.pushed(sensor.position);
    return sensor;
}

std::optional<Hit> surface_under(const SurfaceReader& surfaces, const RayCaster& caster, const Sensor& sensor) {
    if (sensor.response != Response::planar) return std::nullopt;
    const std::optional<Hit> hit = caster.nearest(sensor.position, -sensor.normal, on_surface_within);
    if (!hit) return std::nullopt;
    const vec3 n = surfaces.surface_at(hit->triangle, hit->barycentrics).geometric_normal;
    return std::abs(dot(n, sensor.normal)) < min_alignment ? std::nullopt : hit;
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

bool is_at_lamp(const Scene& scene, const Sensor& sensor) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& lamp) {
        return is_at_point(lamp.type) && length(lamp.position - sensor.position) < lamp_within;
    });
}

}  // namespace lw
