// Photon tracing: particles leave the lamps at unit power and are stored at every surface that is not purely specular
// (Jensen 2001). Unit power as in Graglia, Sequeira, Mavromatis, Real-Time Walkthrough Rendering, 2012 ("the paper"),
// section 2.3.
#pragma once
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

struct ShootSettings {
    uint64_t photons = 1'000'000;  // photons to store in all; the result has within about 1 % of that
    uint64_t seed = 1;
    bool direct_in_photons = false;  // also store photons straight from a lamp; else shadow rays bring that light
};

/// Traces photons of all lamps. Every photon is a function of (seed, lamp, index): the result is the same at any thread
/// count. A lamp's share of the photons follows the square root of the light it sends into the scene, with a floor, so
/// that a dim lamp turned up later is not noise. Throws Error when interrupted or when no photon meets a surface.
Photons shoot_photons(const Scene& scene, const RayCaster& caster, const ShootSettings& settings);

}  // namespace lw
