#include "maps/bake.h"

#include "maps/build.h"

namespace lw {

PhotonMap bake(const Scene& scene, const RayCaster& caster, const BakeSettings& settings, const PhotonsTraced& traced) {
    const Photons photons = shoot_photons(
        scene, caster,
        {.photons = settings.photons, .seed = settings.seed, .direct_in_photons = settings.direct_in_photons});
    if (traced) traced(photons);
    return build_photon_map(scene, caster, photons, settings);
}

}  // namespace lw
