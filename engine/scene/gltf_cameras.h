// Cameras of a glTF file as named pinholes; one is made up when the file has none.
#pragma once
#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Fills cameras: by the camera's own name when a single node places it, else by the node's. Bounds must be known.
void load_cameras(GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene);

}  // namespace lw
