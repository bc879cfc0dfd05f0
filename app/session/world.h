// The building as the walkthrough needs it: the scene, a ray caster, a hierarchy for rays on the GPU, and collisions.
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
    std::map<size_t, Luminaire> luminaires;  // by lamp, for those with a light distribution
};

/// Loads the map at `path`. When that fails, returns null and sets `reason`: the map is damaged or of another scene; ""
/// when there is no file.
std::shared_ptr<const PhotonMap> try_load_map(const std::filesystem::path& path, const Scene& scene,
                                              std::string& reason);

}  // namespace lw
