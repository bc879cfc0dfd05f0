// The building as the walkthrough needs it: the scene, rays through it, what bodies bump into.
#pragma once
#include <map>
#include <memory>

#include "app/session/luminaire.h"
#include "app/walk/collision_mesh.h"
#include "maps/photon_map.h"
#include "scene/bvh.h"
#include "scene/load_scene.h"

namespace lw {

struct World {
    /// load_scene(), whose warnings are printed. Throws Error as that.
    World(const std::filesystem::path& path, const LampPresets& presets, const std::vector<std::string>& photometry);

    Scene scene;
    RayCaster caster;
    Bvh bvh;
    CollisionMesh collision;
    std::map<size_t, Luminaire> luminaires;  // of lamps with a light distribution
};

/// The map at `path`, or none with the reason ("" when there is just no file): missing, stale or damaged.
std::shared_ptr<const PhotonMap> try_load_map(const std::filesystem::path& path, const Scene& scene,
                                              std::string& reason);

}  // namespace lw
