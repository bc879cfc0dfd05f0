// Skinned meshes in their rest pose (glTF 2.0, section 3.7.3.3): joints place the vertices, the node itself does not.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf_primitive.h"

namespace lw {

/// World matrices of all nodes of the file, also of those outside the default scene; joints may be anywhere.
std::vector<glm::dmat4> world_matrices(const GltfFile& file);

/// For each joint of a skin the matrix from the mesh's bind pose to world space. Throws Error for a joint that does not
/// exist and for inverse bind matrices that are missing or not finite.
std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int skin, const std::vector<glm::dmat4>& worlds);

/// The primitive with each vertex moved by its joints, relative to the world position `anchor`. Throws Error for a
/// vertex that names a joint beyond the skin.
LocalPrimitive posed(const GltfFile& file, const LocalPrimitive& primitive, const std::vector<glm::dmat4>& joints,
                     glm::dvec3 anchor);

}  // namespace lw
