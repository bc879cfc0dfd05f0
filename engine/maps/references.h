// Which photons each map refers to (paper, section 2.1): the photon's own, and those of triangles within the radius whose
// normal differs by less than the angle. One Embree point query per photon replaces the paper's neighbour lists: the
// same references, without lists that grow with the square of the triangles.
#pragma once
#include <vector>

#include "maps/patches.h"
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// References sorted by map: those of map m are photons[starts[m]] .. photons[starts[m + 1] - 1].
struct References {
    std::vector<uint64_t> starts;  // patches.count + 1
    std::vector<uint> photons;     // indices of photons, ascending within a map
};

/// A photon on a parallel sheet above or below a triangle does not belong to it: its height over the triangle's plane
/// may not exceed what the angle between the two surfaces explains, beyond a hundredth of the radius.
References find_references(const Scene& scene, const RayCaster& caster, const std::vector<Photon>& photons,
                           const Patches& patches, const BakeSettings& settings);

/// References per photon at this radius, from about `samples` photons spread over the whole set.
double sample_references(const Scene& scene, const RayCaster& caster, const std::vector<Photon>& photons,
                         const Patches& patches, const BakeSettings& settings, size_t samples);

}  // namespace lw
