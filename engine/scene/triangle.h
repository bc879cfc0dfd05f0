// Geometry of one triangle.
#pragma once
#include "shaders/types.h"

namespace lw {

/// Closest point of triangle (a, b, c) to p, also for degenerate triangles (Ericson 2005, section 5.1.5).
vec3 closest_point_on_triangle(vec3 p, vec3 a, vec3 b, vec3 c);

}  // namespace lw
