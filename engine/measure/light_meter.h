// Reads sensors anywhere: direct light of each lamp by shadow rays, reflected light by rays to the surfaces around
// (measure/gathering.h), and on a surface the caustics that lie on it.
#pragma once
#include <span>

#include "maps/photon_map.h"
#include "measure/reading.h"
#include "measure/sensor.h"
#include "trace/ray_caster.h"

namespace lw {

struct MeterSettings {
    uint rays = 1024;  // rays to the surroundings, and half as many to each emissive mesh; a multiple of `repetitions`
    uint64_t seed = 1;
};

/// Reads all sensors: one reading each, in their order. The result does not depend on the number of threads. Throws
/// Error when interrupted.
std::vector<Reading> read_sensors(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                  std::span<const Sensor> sensors, const MeterSettings& settings);

/// The part, 0 to 1, of all reflected light (at the powers in the file) that points and suns send to surfaces by way of
/// mirrors or lenses. A sensor in the air cannot measure this light.
double share_of_caustics(const Scene& scene, const PhotonMap& map);

}  // namespace lw
