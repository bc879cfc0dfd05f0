// Lamps of EXT_lights_ies: nodes with a photometric file, which is beside the scene or in one of its buffers.
#pragma once
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Adds the lamp of a node that has one. Throws Error for a bad reference or file.
void add_profile_light(GltfFile& file, const PlacedNode& at, Scene& scene);

/// C0 of a lamp at a node: its x axis, made perpendicular to `direction`.
vec3 across_of(const PlacedNode& at, vec3 direction);

}  // namespace lw
