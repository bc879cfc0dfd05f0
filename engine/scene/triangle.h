// The geometry of a triangle of the scene.
#pragma once
#include <array>

#include "scene/scene.h"

namespace lw {

/// Its corners, m, in the order of its front.
inline std::array<vec3, 3> triangle_corners(const Scene& scene, size_t triangle) {
    const uvec3 c = scene.triangles[triangle];
    return {scene.positions[c.x], scene.positions[c.y], scene.positions[c.z]};
}

/// edge_product() in double: along the normal of the front, as long as twice the area.
inline glm::dvec3 edge_product(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return glm::cross(b - a, c - a); }

/// edge_product() of its corners, m2.
inline vec3 triangle_product(const Scene& scene, size_t triangle) {
    const auto [a, b, c] = triangle_corners(scene, triangle);
    return edge_product(a, b, c);
}

/// One side, m2.
inline double triangle_area(const Scene& scene, size_t triangle) {
    return 0.5 * double(length(triangle_product(scene, triangle)));
}

/// Closest point of triangle (a, b, c) to p, also for degenerate triangles (Ericson 2005, section 5.1.5).
vec3 closest_point_on_triangle(vec3 p, vec3 a, vec3 b, vec3 c);

}  // namespace lw
