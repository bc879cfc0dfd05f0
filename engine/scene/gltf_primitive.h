// One mesh primitive of a glTF file as plain local-space arrays: every index width, mode and attribute encoding.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_materials.h"

namespace lw {

/// Local-space triangles; optional arrays are empty or as long as `positions`. Only referenced vertices are kept.
struct LocalPrimitive {
    int material = -1;  // index in the file, -1: the default material
    std::vector<vec3> positions, normals;
    std::vector<vec2> uv0, uv1;
    std::vector<vec4> colors, tangents;
    std::vector<uvec3> triangles;
};

/// Decodes primitive `index` of a mesh. Missing normals become flat ones (vertices duplicated); tangents are read or
/// made where a normal map needs them. Points and lines give no triangles and a warning.
LocalPrimitive decode_primitive(GltfFile& file, size_t mesh, size_t index, const Scene& scene);

}  // namespace lw
