// Cameras of a glTF file as named pinholes; one is made up when the file has none.
#pragma once
#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Fills scene.cameras. A camera has its own name when a single node places it, else the name of the node. scene.bounds
/// must be set.
void load_cameras(GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene);

}  // namespace lw
