// All mesh instances of a glTF file as world-space triangles of a Scene, one Object per primitive of an instance.
#pragma once
#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Appends every placed mesh: origin, vertices, triangles, objects, bounds. Materials must be loaded.
/// Returns the file's node of each object. Throws Error when there is no triangle.
std::vector<size_t> load_geometry(GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene);

}  // namespace lw
