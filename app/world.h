// The building as the walkthrough needs it: the scene, rays through it, what bodies bump into.
#pragma once
#include <memory>

#include "app/surroundings.h"
#include "maps/photon_map.h"
#include "scene/bvh.h"

namespace lw {

struct World {
    /// Loads the scene, prints its warnings. Throws Error as load_gltf().
    explicit World(const std::filesystem::path& path);

    Scene scene;
    RayCaster caster;
    Bvh bvh;
    Surroundings around;
};

/// The map at `path`, or none with the reason ("" when there is just no file): missing, stale or damaged.
std::shared_ptr<const PhotonMap> try_load_map(const std::filesystem::path& path, const Scene& scene,
                                              std::string& reason);

}  // namespace lw
