// The node tree of a glTF file flattened: which nodes of the scene are placed, and where, in double precision.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "shaders/types.h"

namespace lw {

struct PlacedNode {
    size_t node;       // index in the model
    glm::dmat4 world;  // node space to world
    int parent = -1;   // index in the model, -1 at the root
};

/// Nodes of the default scene in depth-first order. Throws Error for a cycle or a node with two parents.
std::vector<PlacedNode> place_nodes(const GltfFile& file);

/// Of a node to its parent.
glm::dmat4 local_matrix(const tinygltf::Node& node);

/// Cofactors of a matrix times the sign of its determinant: what turns normals, up to a positive factor; the inverse
/// transpose where there is one.
glm::dmat3 normal_matrix(const glm::dmat4& world);

/// The vector at length 1, or `otherwise` when it has no direction.
vec3 unit_or(glm::dvec3 v, vec3 otherwise);

/// World matrices of the instances of a mesh node: one, or those of EXT_mesh_gpu_instancing.
std::vector<glm::dmat4> instances_of(const GltfFile& file, const PlacedNode& placed);

/// The node's name; when it has none, `otherwise` followed by the node's index.
std::string name_of(const GltfFile& file, size_t node, const std::string& otherwise);

}  // namespace lw
