#include "app/session/world.h"

#include <cstdio>

#include "base/error.h"
#include "file/map_file.h"
#include "scene/load_scene.h"
#include "trace/build_bvh.h"

namespace lw {
namespace {

Scene load_and_warn(const std::filesystem::path& path, const LampPresets& presets,
                    const std::vector<std::string>& photometry) {
    Scene scene = load_scene(path, presets, photometry);
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return scene;
}

}  // namespace

World::World(const std::filesystem::path& path, const LampPresets& presets, const std::vector<std::string>& photometry)
    : scene(load_and_warn(path, presets, photometry)),
      caster(scene),
      bvh(build_bvh(scene)),
      collision(scene, caster),
      luminaires(luminaires_of(scene, photometry_texts(presets, path, photometry))) {}

std::shared_ptr<const PhotonMap> try_load_map(const std::filesystem::path& path, const Scene& scene,
                                              std::string& reason) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return nullptr;
    try {
        return std::make_shared<const PhotonMap>(load_photon_map(path, scene));
    } catch (const Error& failure) {
        reason = failure.what();
        return nullptr;
    }
}

}  // namespace lw
