#include "trace/emitter.h"

#include <algorithm>
#include <cmath>

#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

/// The cosine to the axis that `u` picks, distributed as the intensity of the spot: uniform in the inner cone, and
/// between the cones by the inverse of the integral of spot_falloff(), a cube root.
float sample_spot_cosine(const Light& light, float u) {
    const float inner = 1 - light.cos_inner, rim = (light.cos_inner - light.cos_outer) / 3;
    const float x = u * (inner + rim);
    if (x < inner) return 1 - x;
    const float t = rim > 0 ? std::cbrt(std::max(0.0f, 1 - (x - inner) / rim)) : 1.0f;
    return light.cos_outer + t * (light.cos_inner - light.cos_outer);
}

constexpr uint max_even_triangles = 8;  // beyond, sixteen samples cost less than the closed form

/// The part of triangle `corners` above the plane through the origin with unit `normal`: up to four corners.
uint clip_to_horizon(const std::array<vec3, 3>& corners, vec3 normal, std::array<vec3, 4>& kept) {
    uint count = 0;
    for (size_t i = 0; i < 3; ++i) {
        const vec3 a = corners[i], b = corners[(i + 1) % 3];
        const float above_a = dot(a, normal), above_b = dot(b, normal);
        if (above_a > 0) kept[count++] = a;
        if ((above_a > 0) != (above_b > 0)) kept[count++] = a + (b - a) * (above_a / (above_a - above_b));
    }
    return count;
}

/// Integral of the cosine over the solid angle of a polygon above the horizon: half the sum, over its edges, of the
/// angle they span times the cosine of the normal of their plane. Its sign follows the order of the corners.
float cosine_integral(const std::array<vec3, 4>& corners, uint count, vec3 normal) {
    float sum = 0;
    for (uint i = 0; i < count; ++i) {
        const vec3 a = corners[i], b = corners[(i + 1) % count];
        const vec3 product = cross(a, b);
        const float sine = length(product);
        if (sine > 0) sum += std::atan2(sine, dot(a, b)) * dot(product, normal) / sine;
    }
    return 0.5f * sum;
}

/// The sample of a light whose place is `position` (m); nullopt when no light comes that way.
std::optional<Incident> incident(const LightSample& sample, vec3 position) {
    if (!(sample.to_light != vec3(0)) || !(sample.radiance.x + sample.radiance.y + sample.radiance.z > 0))
        return std::nullopt;
    return Incident{sample.to_light, position, sample.radiance, sample.pdf};
}

}  // namespace

Emitters::Emitters(const Scene& scene) : scene_(scene), reader_(scene), radius_(radius_around(scene)) {
    centre_ = 0.5f * (scene.bounds[0] + scene.bounds[1]);
    for (const Light& light : scene.lights) {
        profiles_.push_back(has_table(light.type) ? cells_of_profile(scene, light) : ProfileCells{});
        even_radiance_.push_back(even_radiance_of(light));
    }
}

vec3 Emitters::even_radiance_of(const Light& light) const {
    constexpr vec3 uneven(-1);
    if (light.emitter_count == 0) return uneven;
    const Material& first = scene_.material_of(scene_.emitters[light.first_emitter].triangle);
    for (uint i = 0; i < light.emitter_count; ++i) {
        const Material& m = scene_.material_of(scene_.emitters[light.first_emitter + i].triangle);
        const bool holes = (m.flags & (material_alpha_mask | material_alpha_blend)) != 0;
        if (&m != &first || m.emissive_texture.texture >= 0 || holes) return uneven;
    }
    return reader_.per_intensity(light, first.emissive);
}

bool Emitters::is_even(uint index) const {
    return shines_alike(index) && scene_.lights[index].emitter_count <= max_even_triangles;
}

vec3 Emitters::even_irradiance(uint index, vec3 point, vec3 normal) const {
    const Light& light = scene_.lights[index];
    const bool both_sides =
        scene_.material_of(scene_.emitters[light.first_emitter].triangle).flags & material_double_sided;
    float sum = 0;
    for (uint i = 0; i < light.emitter_count; ++i) {
        std::array<vec3, 3> corners = triangle_corners(scene_, scene_.emitters[light.first_emitter + i].triangle);
        for (vec3& corner : corners) corner -= point;
        const float behind = dot(edge_product(corners[0], corners[1], corners[2]), corners[0]);
        if (behind >= 0 && !both_sides) continue;
        std::array<vec3, 4> above;
        const uint count = clip_to_horizon(corners, normal, above);
        sum += std::abs(cosine_integral(above, count, normal));
    }
    return even_radiance_[index] * sum;
}

Surface Emitters::point_of(const Light& light, float u, float v) const {
    float within = 0;
    const uint triangle = reader_.pick_emitter(light, u, within);
    const vec2 place = sample_triangle(within, v);
    if (shines_alike(size_t(&light - scene_.lights.data()))) return even_point(triangle, place);
    Surface s = reader_.surface_at(triangle, place);
    s.emissive *= reader_.opacity_at(triangle, s);  // holes do not glow
    return s;
}

Surface Emitters::even_point(uint triangle, vec2 barycentrics) const {
    const auto [p0, p1, p2] = triangle_corners(scene_, triangle);
    const Material& material = scene_.material_of(triangle);
    const vec3 product = edge_product(p0, p1, p2);
    const float size = length(product);
    Surface s{};
    s.position = (1 - barycentrics.x - barycentrics.y) * p0 + barycentrics.x * p1 + barycentrics.y * p2;
    s.geometric_normal = s.normal = size > 0 ? product / size : vec3(0, 1, 0);
    s.emissive = material.emissive;
    s.flags = material.flags;
    s.light = scene_.objects[scene_.triangle_objects[triangle]].light;
    return s;
}

float Emitters::unit_flux(uint index) const {
    const Light& light = scene_.lights[index];
    return has_table(light.type) ? profiles_[index].flux_below.back() : lw::unit_flux(scene_, light);
}

Emission Emitters::emit(uint index, const std::array<float, 5>& u) const {
    const Light& light = scene_.lights[index];
    const vec3 flux(unit_flux(index));
    switch (light.type) {
        case light_point:
            return {light.position, vec3(0), direction_of(1 - 2 * u[2], u[3]), flux};
        case light_spot:
            return {light.position, vec3(0),
                    frame_around(light.direction) * direction_of(sample_spot_cosine(light, u[2]), u[3]), flux};
        case light_directional: {
            const vec2 disc = sample_disc(u[0], u[1]) * radius_;
            const mat3 frame = frame_around(light.direction);
            return {centre_ + frame * vec3(disc.x, disc.y, -radius_), vec3(0), light.direction, flux};
        }
        case light_mesh:
            return emit_from_mesh(light, u);
        case light_profile:
            return emit_profile(light, profiles_[index], u[2], u[3]);
    }
    return {};
}

/// u picks a cell of the table in proportion to its flux; what is left of u, and v, pick a direction in the cell,
/// uniform by solid angle. The flux of the photon makes up for how the table varies within the cell.
Emission Emitters::emit_profile(const Light& light, const ProfileCells& cells, float u, float v) const {
    const float total = cells.flux_below.back();
    const auto chosen = std::min(std::upper_bound(cells.flux_below.begin(), cells.flux_below.end(), u * total),
                                 cells.flux_below.end() - 1);
    const auto cell = uint(chosen - cells.flux_below.begin());
    const float below = cell == 0 ? 0.0f : cells.flux_below[cell - 1], own = *chosen - below;
    const float within = clamp((u * total - below) / std::max(own, 1e-30f), 0.0f, 0.99999994f);
    const uint column = cell / cells.rows, row = cell % cells.rows;
    const ProfileDirection polar = in_profile_row(row, cells.rows, within);
    const float c = 2 * lw_pi * (float(column) + v) / float(cells.columns);
    const vec3 direction = normalize(light.direction * polar.cosine + light.across * (polar.sine * std::cos(c)) +
                                     cross(light.across, light.direction) * (polar.sine * std::sin(c)));
    const float area = polar.band * 2 * lw_pi / float(cells.columns);
    const float flux = reader_.profile_value(light, direction) * area * total / std::max(own, 1e-30f);
    return {light.position, vec3(0), direction, vec3(flux)};
}

Emission Emitters::emit_from_mesh(const Light& light, const std::array<float, 5>& u) const {
    const Surface s = point_of(light, u[0], u[1]);
    const bool back = (s.flags & material_double_sided) && u[4] >= 0.5f;
    const float sides = s.flags & material_double_sided ? 2.0f : 1.0f;
    const vec3 n = back ? -s.geometric_normal : s.geometric_normal;
    const vec3 relative = reader_.per_intensity(light, s.emissive);
    return {s.position, n, frame_around(n) * sample_cosine(u[2], u[3]),
            relative * (lw_pi * reader_.area_of_surface(light) * sides)};
}

std::optional<Incident> Emitters::arrive(uint index, vec3 point, float u, float v) const {
    const Light& light = scene_.lights[index];
    switch (light.type) {
        case light_point:
        case light_spot:
        case light_profile:
            return incident(reader_.sample_from_point(light, point), light.position);
        case light_directional:
            return incident(reader_.sample_directional(light), point - light.direction * (4 * radius_));
        case light_mesh: {
            const Surface s = point_of(light, u, v);
            const LightPlace place{s.position, s.geometric_normal, 1, s.emissive,
                                   (s.flags & material_double_sided) != 0};
            return incident(reader_.sample_from_place(light, point, place), s.position);
        }
    }
    return std::nullopt;
}

vec3 Emitters::radiance(const Surface& s, vec3 to_view) const {
    if (s.light < 0) return vec3(0);
    if (dot(s.geometric_normal, to_view) <= 0 && !(s.flags & material_double_sided)) return vec3(0);
    return reader_.per_intensity(scene_.lights[size_t(s.light)], s.emissive);
}

float Emitters::arrive_pdf(const Surface& s, float distance, vec3 to_light) const {
    return reader_.light_pdf(scene_.lights[size_t(s.light)], distance, dot(s.geometric_normal, to_light));
}

std::vector<vec3> lamp_powers(const Scene& scene, const std::vector<vec3>& factors) {
    std::vector<vec3> powers;
    for (size_t i = 0; i < scene.lights.size(); ++i)
        powers.push_back(scene.lights[i].intensity * (i < factors.size() ? factors[i] : vec3(1)));
    return powers;
}

}  // namespace lw
