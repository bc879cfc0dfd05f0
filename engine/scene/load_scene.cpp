#include "scene/load_scene.h"

#include <algorithm>

#include "scene/profile.h"

namespace lw {

std::vector<std::string> photometry_texts(const LampPresets& presets, const std::filesystem::path& scene,
                                          const std::vector<std::string>& given) {
    std::vector<std::string> texts;
    for (const auto& [lamp, file] : presets.photometry) {
        const std::string start = lamp + "=";
        const auto names_it = [&](const std::string& text) { return text.starts_with(start); };
        if (std::none_of(given.begin(), given.end(), names_it))
            texts.push_back(start + (scene.parent_path() / file).string());
    }
    texts.insert(texts.end(), given.begin(), given.end());
    return texts;
}

Scene load_scene(const std::filesystem::path& path, const LampPresets& presets,
                 const std::vector<std::string>& photometry, const GltfSettings& settings) {
    Scene scene = with_photometry(load_gltf(path, settings), photometry_texts(presets, path, photometry));
    scene.files.push_back(default_ambiances_path(path));
    return scene;
}

Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& photometry,
                 const GltfSettings& settings) {
    return load_scene(path, load_lamp_presets(default_ambiances_path(path)), photometry, settings);
}

}  // namespace lw
