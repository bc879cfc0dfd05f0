// Lamps of EXT_lights_ies: nodes with a photometric file, which is beside the scene or in one of its buffers.
#pragma once
#include <map>
#include <utility>

#include "scene/gltf_nodes.h"
#include "scene/profile.h"
#include "scene/scene.h"

namespace lw {

/// The profiles that lamps have so far, by their index in the file and whether they are mirrored.
using KnownProfiles = std::map<std::pair<int, bool>, Profile>;

/// Adds the lamp of a node that has this extension; does nothing for other nodes. Throws Error for a bad reference or
/// file.
void add_profile_light(GltfFile& file, const PlacedNode& at, KnownProfiles& known, Scene& scene);

/// The unit direction of plane C0 for a lamp at a node: the node's x axis, made perpendicular to `direction`, the
/// lamp's aim.
vec3 across_of(const PlacedNode& at, vec3 direction);

/// Whether the node mirrors: its y axis, C90, lies against across x direction.
bool is_mirrored(const PlacedNode& at, const Light& light);

}  // namespace lw
