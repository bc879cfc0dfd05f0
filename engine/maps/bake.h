// The whole bake: from a scene to its photon map.
#pragma once
#include <functional>

#include "maps/photon_map.h"
#include "photons/shoot.h"

namespace lw {

/// Called with the photons once all are traced, before the map is built from them.
using PhotonsTraced = std::function<void(const Photons&)>;

/// Shoots photons from all lamps of the scene and builds the photon map from them. `caster` is that of the scene. The
/// same scene and settings give the same bytes at any thread count. Throws Error as shoot_photons() and
/// build_photon_map() do.
PhotonMap bake(const Scene& scene, const RayCaster& caster, const BakeSettings& settings,
               const PhotonsTraced& traced = {});

}  // namespace lw
