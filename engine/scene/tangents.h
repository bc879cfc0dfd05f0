// Tangents for normal maps when a file has none: per-triangle directions of +u summed at the vertices.
#pragma once
#include <vector>

#include "shaders/types.h"

namespace lw {

/// One (tangent, handedness) per vertex, orthogonal to the normal; bitangent = cross(normal, tangent) * w points
/// against growing v, because glTF images have v downwards and normal maps have +Y upwards.
std::vector<vec4> make_tangents(const std::vector<vec3>& positions, const std::vector<vec3>& normals,
                                const std::vector<vec2>& uv, const std::vector<uvec3>& triangles);

}  // namespace lw
