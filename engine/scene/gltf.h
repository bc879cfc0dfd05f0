// Reads a glTF 2.0 building (.gltf or .glb) into a Scene; the only user of tinygltf.
#pragma once
#include <filesystem>

#include "scene/scene.h"

namespace lw {

struct GltfSettings {
    std::string variant{};   // of KHR_materials_variants; "": the materials as they stand
    bool strict = false;     // a required extension that is not read is refused even where it changes only the look
    bool needs_lamp = true;  // a scene without a lamp is refused; not so where daylight lights it
};

/// Loads the default scene of a glTF 2.0 file: compressed geometry decoded, figures in their rest pose, node hierarchy
/// flattened to world space, lamps named, a camera added when the file has none. Throws Error("file: element: what")
/// for anything malformed, for a required extension that may change the geometry and is not read, and, with
/// `needs_lamp`, for a scene without a lamp. What is ignored or replaced is told once in Scene::warnings.
Scene load_gltf(const std::filesystem::path& path, const GltfSettings& settings = {});

}  // namespace lw
