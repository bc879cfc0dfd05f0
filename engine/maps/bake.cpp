#include "maps/bake.h"

#include "maps/build.h"

namespace lw {

ShootSettings shoot_settings(const BakeSettings& settings) {
    return {.photons = settings.photons, .seed = settings.seed, .direct_in_photons = settings.direct_in_photons};
}

PhotonMap bake(const Scene& scene, const RayCaster& caster, const BakeSettings& settings) {
    return build_photon_map(scene, caster, shoot_photons(scene, caster, shoot_settings(settings)), settings);
}

}  // namespace lw
