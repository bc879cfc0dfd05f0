// One mesh primitive of a glTF file as plain local-space arrays: every index width, mode and attribute encoding.
#pragma once
#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_materials.h"

namespace lw {

/// The joints that move a vertex, and how much of each; weights sum to 1.
struct JointWeights {
    std::array<uint, 8> joints{};  // of the skin; those beyond JOINTS_0 and JOINTS_1 have no weight
    std::array<float, 8> weights{};
};

/// Local-space triangles; optional arrays are empty or as long as `positions`. Only referenced vertices are kept.
struct LocalPrimitive {
    int material = -1;  // index in the file, -1: the default material
    std::vector<vec3> positions, normals;
    std::vector<vec2> uv0, uv1;
    std::vector<vec4> colors, tangents;
    std::vector<JointWeights> joints;  // of skinned primitives
    std::vector<uvec3> triangles;
};

/// How a node shows its mesh.
struct MeshPose {
    std::vector<double> morph_weights;  // one per target, fewer: the others 0
    bool is_skinned = false;
    auto operator<=>(const MeshPose&) const = default;
};

/// Decodes primitive `index` of a mesh in a pose: morph targets added (glTF 2.0, section 3.7.2.2), the joints of each
/// vertex read when it is skinned. Missing normals become flat ones (vertices duplicated); tangents are read or made
/// where a normal map needs them. Points and lines give no triangles and a warning.
LocalPrimitive decode_primitive(GltfFile& file, size_t mesh, size_t index, const MeshPose& pose, const Scene& scene);

}  // namespace lw
