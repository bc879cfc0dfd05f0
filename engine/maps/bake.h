// The whole bake: from a scene to its photon map.
#pragma once
#include "maps/photon_map.h"
#include "photons/shoot.h"

namespace lw {

/// The settings of the photon tracing that are part of the settings of a bake.
ShootSettings shoot_settings(const BakeSettings& settings);

/// Shoots photons from all lamps of the scene and builds the photon map from them. `caster` is that of the scene. The
/// same scene and settings give the same bytes at any thread count. Throws Error as shoot_photons() and
/// build_photon_map() do. Who needs the photons themselves, or the cost of each half, calls these two.
PhotonMap bake(const Scene& scene, const RayCaster& caster, const BakeSettings& settings);

}  // namespace lw
