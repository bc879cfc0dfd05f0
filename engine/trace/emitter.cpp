#include "trace/emitter.h"

#include <algorithm>
#include <cmath>

#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

vec3 per_intensity(vec3 value, vec3 intensity) {
    vec3 result(0);
    for (int c = 0; c < 3; ++c)
        if (intensity[c] > 0) result[c] = value[c] / intensity[c];
    return result;
}

/// KHR_lights_punctual: t^2 with t linear in the cosine between the cones.
float spot_falloff(const Light& light, float cosine) {
    const float width = std::max(light.cos_inner - light.cos_outer, 1e-6f);
    const float t = clamp((cosine - light.cos_outer) / width, 0.0f, 1.0f);
    return t * t;
}

/// Cosine to the axis, distributed as the falloff: inner cone uniform, penumbra cubic.
float sample_spot_cosine(const Light& light, float u) {
    const float inner = 1 - light.cos_inner, rim = (light.cos_inner - light.cos_outer) / 3;
    const float x = u * (inner + rim);
    if (x < inner) return 1 - x;
    const float t = rim > 0 ? std::cbrt(std::max(0.0f, 1 - (x - inner) / rim)) : 1.0f;
    return light.cos_outer + t * (light.cos_inner - light.cos_outer);
}

constexpr size_t max_beam_cells = 131'072;  // of more, the running sum of flux in float loses some
constexpr uint max_even_triangles = 8;      // beyond, sixteen samples cost less than the closed form

/// A direction within a row of a table that has `rows` from pole to pole: `within` of its solid angle from its start.
struct InRow {
    float cosine, sine;
    float band;  // solid angle of the row over 2 pi
};

/// In float or, as float does not part the cosines near a pole, in double for rows finer than half a degree.
template <class T>
InRow in_row_by(uint row, uint rows, float within) {
    const T low = std::cos(T(lw_pi) * T(row) / T(rows)), high = std::cos(T(lw_pi) * T(row + 1) / T(rows));
    const T cosine = low + T(within) * (high - low);
    return {float(cosine), float(std::sqrt(std::max(T(0), 1 - cosine * cosine))), float(low - high)};
}

InRow in_row(uint row, uint rows, float within) {
    return rows > 360 ? in_row_by<double>(row, rows, within) : in_row_by<float>(row, rows, within);
}

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

}  // namespace

Emitters::Emitters(const Scene& scene) : scene_(scene), surfaces_(scene) {
    centre_ = 0.5f * (scene.bounds[0] + scene.bounds[1]);
    radius_ = 0.5f * length(scene.bounds[1] - scene.bounds[0]) * 1.001f;
    for (const Light& light : scene.lights)
        if (light.type == light_profile && !beams_.contains(light.profile)) beams_[light.profile] = beam_of(light);
    for (const Light& light : scene.lights) even_radiance_.push_back(even_radiance_of(light));
}

vec3 Emitters::even_radiance_of(const Light& light) const {
    constexpr vec3 uneven(-1);
    if (light.type != light_mesh) return uneven;
    const Material& first = scene_.material_of(scene_.emitters[light.first_emitter].triangle);
    for (uint i = 0; i < light.emitter_count; ++i) {
        const Material& m = scene_.material_of(scene_.emitters[light.first_emitter + i].triangle);
        const bool holes = (m.flags & (material_alpha_mask | material_alpha_blend)) != 0;
        if (&m != &first || m.emissive_texture.texture >= 0 || holes) return uneven;
    }
    return per_intensity(first.emissive, light.intensity);
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

Emitters::Beam Emitters::beam_of(const Light& light) const {
    // A round distribution has one column, which is cut so that no cell goes all around.
    const uint columns = std::max(scene_.texels[light.profile], 4u), rows = scene_.texels[light.profile + 1] - 1;
    const uint step = scene_.texels[light.profile] == 1 ? 0 : 1;
    Beam beam{columns, rows, {}};
    // Halved on the wider side: there the light varies less.
    while (size_t(beam.columns) * beam.rows > max_beam_cells) {
        const bool wide = 2 * beam.rows > beam.columns;
        uint &wider = wide ? beam.columns : beam.rows, &other = wide ? beam.rows : beam.columns;
        uint& halved = wider % 2 == 0 ? wider : other;
        if (halved % 2 != 0) break;
        halved /= 2;
    }
    double sum = 0;
    const auto at = [&](uint i, uint j) { return double(surfaces_.profile_entry(light.profile, i * step, j)); };
    const auto add_cell = [&](uint c, uint r) {
        const double area = double(in_row(r, rows, 0).band) * 2 * double(lw_pi) / columns;
        sum += area * (at(c, r) + at(c + 1, r) + at(c, r + 1) + at(c + 1, r + 1)) / 4;
    };
    const uint across = columns / beam.columns, along = rows / beam.rows;
    for (uint i = 0; i < columns; i += across)
        for (uint j = 0; j < rows; j += along) {
            for (uint c = i; c < i + across; ++c)
                for (uint r = j; r < j + along; ++r) add_cell(c, r);
            beam.flux_below.push_back(float(sum));
        }
    return beam;
}

Emission Emitters::emit_profile(const Light& light, const Beam& beam, float u, float v) const {
    const float total = beam.flux_below.back();
    const auto chosen = std::min(std::upper_bound(beam.flux_below.begin(), beam.flux_below.end(), u * total),
                                 beam.flux_below.end() - 1);
    const auto cell = uint(chosen - beam.flux_below.begin());
    const float below = cell == 0 ? 0.0f : beam.flux_below[cell - 1], own = *chosen - below;
    const float within = clamp((u * total - below) / std::max(own, 1e-30f), 0.0f, 0.99999994f);
    const uint column = cell / beam.rows, row = cell % beam.rows;
    const InRow polar = in_row(row, beam.rows, within);
    const float c = 2 * lw_pi * (float(column) + v) / float(beam.columns);
    const vec3 direction = normalize(light.direction * polar.cosine + light.across * (polar.sine * std::cos(c)) +
                                     cross(light.across, light.direction) * (polar.sine * std::sin(c)));
    const float area = polar.band * 2 * lw_pi / float(beam.columns);
    const float flux = surfaces_.profile_value(light, direction) * area * total / std::max(own, 1e-30f);
    return {light.position, vec3(0), direction, vec3(flux)};
}

float Emitters::area_of(const Light& light) const {
    return scene_.emitters[light.first_emitter + light.emitter_count - 1].area_below;
}

Surface Emitters::point_of(uint index, float u, float v) const {
    const Light& light = scene_.lights[index];
    const auto first = scene_.emitters.begin() + light.first_emitter, last = first + light.emitter_count;
    const float wanted = u * area_of(light);
    const auto below = [](float area, const Emitter& e) { return area < e.area_below; };
    const auto chosen = std::min(std::upper_bound(first, last, wanted, below), last - 1);
    const float start = chosen == first ? 0.0f : (chosen - 1)->area_below;
    const float within = clamp((wanted - start) / std::max(chosen->area_below - start, 1e-30f), 0.0f, 0.99999994f);
    const vec2 place = sample_triangle(within, v);
    if (shines_alike(index)) return even_point(chosen->triangle, place);
    Surface s = surfaces_.surface_at(chosen->triangle, place);
    s.emissive *= surfaces_.opacity_at(chosen->triangle, s);  // holes do not glow
    return s;
}

/// surface_at() for what a lamp that shines alike all over needs: its place and what it emits.
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
    switch (light.type) {
        case light_point:
            return 4 * lw_pi;
        case light_spot:
            return 2 * lw_pi * ((1 - light.cos_inner) + (light.cos_inner - light.cos_outer) / 3);
        case light_profile:
            return beams_.at(light.profile).flux_below.back();
        case light_directional:
            return lw_pi * radius_ * radius_;
        default:
            return lw_pi * light.area;
    }
}

Emission Emitters::emit(uint index, const std::array<float, 5>& u) const {
    const Light& light = scene_.lights[index];
    const vec3 flux(unit_flux(index));
    if (light.type == light_point) return {light.position, vec3(0), direction_of(1 - 2 * u[2], u[3]), flux};
    if (light.type == light_profile) return emit_profile(light, beams_.at(light.profile), u[2], u[3]);
    if (light.type == light_spot)
        return {light.position, vec3(0),
                frame_around(light.direction) * direction_of(sample_spot_cosine(light, u[2]), u[3]), flux};
    if (light.type == light_directional) {
        const vec2 disc = sample_disc(u[0], u[1]) * radius_;
        const mat3 frame = frame_around(light.direction);
        return {centre_ + frame * vec3(disc.x, disc.y, -radius_), vec3(0), light.direction, flux};
    }
    const Surface s = point_of(index, u[0], u[1]);
    const bool back = (s.flags & material_double_sided) && u[4] >= 0.5f;
    const float sides = s.flags & material_double_sided ? 2.0f : 1.0f;
    const vec3 n = back ? -s.geometric_normal : s.geometric_normal;
    const vec3 relative = per_intensity(s.emissive, light.intensity);
    return {s.position, n, frame_around(n) * sample_cosine(u[2], u[3]), relative * (lw_pi * area_of(light) * sides)};
}

std::optional<Incident> Emitters::arrive(uint index, vec3 point, float u, float v) const {
    const Light& light = scene_.lights[index];
    if (light.type == light_directional)
        return Incident{-light.direction, point - light.direction * (4 * radius_), vec3(1), 0};
    if (light.type != light_mesh) {
        const vec3 path = light.position - point;
        const float d2 = dot(path, path);
        if (!(d2 > 0)) return std::nullopt;
        const vec3 to_light = path / std::sqrt(d2);
        const float falloff = light.type == light_spot      ? spot_falloff(light, -dot(to_light, light.direction))
                              : light.type == light_profile ? surfaces_.profile_value(light, -to_light)
                                                            : 1.0f;
        if (falloff <= 0) return std::nullopt;
        return Incident{to_light, light.position, vec3(falloff / d2), 0};
    }
    const Surface s = point_of(index, u, v);
    const vec3 path = s.position - point;
    const float distance = length(path);
    if (!(distance > 0)) return std::nullopt;
    const vec3 to_light = path / distance;
    const float pdf = arrive_pdf(s, distance, to_light);
    const vec3 emitted = radiance(s, -to_light);
    if (!(pdf > 0) || (emitted.x + emitted.y + emitted.z) <= 0) return std::nullopt;
    return Incident{to_light, s.position, emitted, pdf};
}

vec3 Emitters::radiance(const Surface& s, vec3 to_view) const {
    if (s.light < 0) return vec3(0);
    if (dot(s.geometric_normal, to_view) <= 0 && !(s.flags & material_double_sided)) return vec3(0);
    return per_intensity(s.emissive, scene_.lights[size_t(s.light)].intensity);
}

float Emitters::arrive_pdf(const Surface& s, float distance, vec3 to_light) const {
    const Light& light = scene_.lights[size_t(s.light)];
    const float cosine = abs(dot(s.geometric_normal, to_light));
    return cosine > 1e-6f ? distance * distance / (cosine * area_of(light)) : 0.0f;
}

std::vector<vec3> light_powers(const Scene& scene, const std::vector<vec3>& factors) {
    std::vector<vec3> weights;
    for (size_t i = 0; i < scene.lights.size(); ++i)
        weights.push_back(scene.lights[i].intensity * (i < factors.size() ? factors[i] : vec3(1)));
    return weights;
}

}  // namespace lw
