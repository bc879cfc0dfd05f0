// Lamps of EXT_lights_ies: nodes with a photometric file, which is beside the scene or in one of its buffers.
#pragma once
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Adds the lamp of a node that has this extension; does nothing for other nodes. Throws Error for a bad reference or
/// file.
void add_profile_light(GltfFile& file, const PlacedNode& at, Scene& scene);

/// The unit direction of plane C0 for a lamp at a node: the node's x axis, made perpendicular to `direction`, the
/// lamp's aim.
vec3 across_of(const PlacedNode& at, vec3 direction);

}  // namespace lw
