#include "scene/tangents.h"

#include <cmath>

namespace lw {
namespace {

vec3 any_perpendicular(vec3 n) {
    const vec3 axis = std::abs(n.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(axis, n));
}

}  // namespace

std::vector<vec4> make_tangents(const std::vector<vec3>& positions, const std::vector<vec3>& normals,
                                const std::vector<vec2>& uv, const std::vector<uvec3>& triangles) {
    std::vector<vec3> along_u(positions.size(), vec3(0)), against_v(positions.size(), vec3(0));
    for (uvec3 t : triangles) {
        const vec3 e1 = positions[t.y] - positions[t.x], e2 = positions[t.z] - positions[t.x];
        const vec2 d1 = uv[t.y] - uv[t.x], d2 = uv[t.z] - uv[t.x];
        const float determinant = d1.x * d2.y - d2.x * d1.y;
        if (determinant == 0 || !std::isfinite(determinant)) continue;
        const float sign = determinant < 0 ? -1.0f : 1.0f;  // area-weighted: not divided by the determinant
        for (int c = 0; c < 3; ++c) {
            along_u[t[c]] += sign * (e1 * d2.y - e2 * d1.y);
            against_v[t[c]] -= sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    std::vector<vec4> tangents(positions.size());
    for (size_t i = 0; i < tangents.size(); ++i) {
        const vec3 n = normals[i], t = along_u[i] - n * dot(n, along_u[i]);
        const float t_length = length(t);
        const vec3 tangent = t_length > 0 && std::isfinite(t_length) ? t / t_length : any_perpendicular(n);
        tangents[i] = vec4(tangent, dot(cross(n, tangent), against_v[i]) < 0 ? -1.0f : 1.0f);
    }
    return tangents;
}

}  // namespace lw
