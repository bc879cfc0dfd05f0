// Reads a glTF 2.0 building (.gltf or .glb) into a Scene; the only user of tinygltf.
#pragma once
#include <filesystem>

#include "scene/scene.h"

namespace lw {

/// Loads the default scene of a glTF 2.0 file: node hierarchy flattened to world space, lamps named, a camera added
/// when the file has none. Throws Error("file: element: what") for anything malformed, for an unsupported entry of
/// extensionsRequired, and for a scene without light. What is ignored or replaced is told once in Scene::warnings.
Scene load_gltf(const std::filesystem::path& path);

}  // namespace lw
