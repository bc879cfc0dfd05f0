// Lamps of a glTF file: KHR_lights_punctual nodes and nodes with emissive meshes, each a named Light.
#pragma once
#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lw {

/// Fills lights, light_names, emitters and Object::light. Geometry must be loaded; `object_nodes` is what it returned.
/// Warns once when the strengths look non-photometric. Throws Error with advice when there is no light.
void load_lights(GltfFile& file, const std::vector<PlacedNode>& nodes, const std::vector<size_t>& object_nodes,
                 Scene& scene);

/// Makes names unique by the suffixes _2, _3 ...
void make_unique(std::vector<std::string>& names);

}  // namespace lw
