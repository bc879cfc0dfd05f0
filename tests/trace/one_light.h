// A light of any type alone in a scene, and what it does by closed forms. A new type of light needs a case in each.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "scene/profile.h"
#include "scene/scene.h"
#include "trace/direction_bins.h"

namespace lw::test {

constexpr vec3 place(0.2f, -0.1f, 2);                     // of the light
constexpr vec3 aim(0, 0, -1);                             // its direction
constexpr float width = 0.6f, height = 0.4f;              // of the mesh
constexpr float cos_inner = 0.9f, cos_outer = 0.7f;       // of the spot
constexpr std::array<vec3, 2> bounds{vec3(-2), vec3(2)};  // of the scene

inline std::vector<LightType> all_types() {
    std::vector<LightType> types;
    for (uint type = 0; type < light_type_count; ++type) types.push_back(LightType(type));
    return types;
}

inline Photometry batwing() { return read_photometry(LUMENWALK_SOURCE_DIR "/data/photometry/batwing.ies"); }

/// Candela over those of the strongest direction, from the file itself.
inline double share_of_file(vec3 direction) {
    static const Photometry photometry = batwing();
    static const double strongest = [] {
        double most = 0;
        for (double gamma = 0; gamma <= pi; gamma += pi / 360)
            for (double c = 0; c < 2 * pi; c += pi / 72)
                most = std::max(most, candela_at(photometry, {std::sin(gamma) * std::cos(c),
                                                              std::sin(gamma) * std::sin(c), -std::cos(gamma)}));
        return most;
    }();
    return candela_at(photometry, glm::dvec3(direction)) / strongest;
}

/// Adds a rectangle of width x height around `place` that glows towards `aim`.
inline void add_rectangle(Scene& scene, Light& light) {
    const vec3 u(width, 0, 0), v(0, -height, 0), corner = place - 0.5f * (u + v);
    scene.positions = {corner, corner + u, corner + u + v, corner + v};
    scene.normals.assign(4, aim);
    scene.triangles = {uvec3(0, 1, 2), uvec3(0, 2, 3)};
    scene.triangle_objects = {0, 0};
    scene.objects = {{0, 0}};
    Material glowing{};
    glowing.emissive = light.intensity;
    glowing.emissive_texture.texture = -1;
    scene.materials = {glowing};
    light.area = width * height;
    light.emitter_count = 2;
    scene.emitters = {{0, light.area / 2}, {1, light.area}};
}

inline Scene scene_with(LightType type) {
    Scene scene;
    scene.bounds = bounds;
    Light light{};
    light.type = type;
    light.intensity = vec3(3, 2, 1);
    light.position = place;
    light.direction = aim;
    light.across = vec3(1, 0, 0);
    switch (type) {
        case light_point:
        case light_directional:
            break;
        case light_spot:
            light.cos_inner = cos_inner, light.cos_outer = cos_outer;
            break;
        case light_mesh:
            add_rectangle(scene, light);
            break;
        case light_profile:
            attach_profile(add_profile(batwing(), false, scene), light);
            break;
    }
    scene.lights = {light};
    return scene;
}

/// Where on the light a photon starts, such that all of [0, 1) x [0, 1) is as likely; nothing for lights at a point.
inline std::optional<vec2> start_of(LightType type, vec3 origin) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return std::nullopt;
        case light_directional: {
            const vec2 disc = vec2(origin) / (0.5f * length(bounds[1] - bounds[0]) * 1.001f);
            return vec2(dot(disc, disc), std::atan2(disc.y, disc.x) / (2 * lw_pi) + 0.5f);
        }
        case light_mesh:
            return (vec2(origin) - vec2(place)) / vec2(width, height) + 0.5f;
    }
    return std::nullopt;
}

/// Whether the light covers a point of its plane, at an offset from its place.
inline bool covers(LightType type, vec3 offset) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return false;
        case light_mesh:
            return std::abs(offset.x) < width / 2 && std::abs(offset.y) < height / 2;
    }
    return false;
}

/// KHR_lights_punctual.
inline double falloff(double cosine) {
    const double t = std::clamp((cosine - double(cos_outer)) / double(cos_inner - cos_outer), 0.0, 1.0);
    return t * t;
}

/// lm/sr that leave the whole light towards a unit direction, per unit intensity; 0 for parallel light.
inline double intensity_of(LightType type, vec3 direction) {
    switch (type) {
        case light_point:
            return 1;
        case light_spot:
            return falloff(double(dot(direction, aim)));
        case light_directional:
            return 0;
        case light_mesh:
            return double(width * height) * std::max(0.0, double(dot(direction, aim)));
        case light_profile:
            return share_of_file(direction);
    }
    return 0;
}

/// lx on a plane with unit `normal` at a point below the light, per unit intensity.
inline double irradiance_of(LightType type, vec3 point, vec3 normal) {
    const vec3 path = place - point;
    const double d2 = double(dot(path, path)), cosine = double(dot(path, normal)) / std::sqrt(d2);
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return intensity_of(type, normalize(-path)) * cosine / d2;
        case light_directional:
            return double(-dot(aim, normal));
        case light_mesh: {
            // The form factor of the rectangle between the foot of the point and a corner (Howell, C-11), over all four
            // corners; for a plane that is parallel to it.
            const double h = double(path.z);
            double sum = 0;
            for (int sx : {-1, 1})
                for (int sy : {-1, 1}) {
                    const double x = (double(path.x) * sx + double(width) / 2) / h,
                                 y = (double(path.y) * sy + double(height) / 2) / h;
                    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
                    sum += (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / 2;
                }
            return sum;
        }
    }
    return 0;
}

}  // namespace lw::test
