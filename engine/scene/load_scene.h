// The scene as every program sees it: the glTF file, with the photometric files that the user and SCENE.ambiances.json
// put on its lamps.
#pragma once
#include "scene/ambiance.h"
#include "scene/gltf.h"

namespace lw {

/// "LAMP=FILE" texts: those of the presets beside a scene, but for lamps that `given` names, then `given`.
std::vector<std::string> photometry_texts(const LampPresets& presets, const std::filesystem::path& scene,
                                          const std::vector<std::string>& given);

/// load_gltf() with the files of photometry_texts() on its lamps. Throws Error as load_gltf() and with_photometry().
Scene load_scene(const std::filesystem::path& path, const LampPresets& presets,
                 const std::vector<std::string>& photometry, const GltfSettings& settings = {});

/// The same with the presets beside the scene. Throws Error, too, when that file is malformed.
Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& photometry,
                 const GltfSettings& settings = {});

}  // namespace lw
