// Final gathering at the nodes of the lattices (Jensen 2001, section 8.3.2): rays from a node look at the light of the
// surfaces around, which averages away what single photons and their kernels get wrong.
#pragma once
#include <span>
#include <vector>

#include "base/progress.h"
#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// What final gathering reads; all of it must outlive the call.
struct GatherInput {
    const Scene& scene;
    const RayCaster& caster;
    const Lattice& lattice;
    const PhotonGrids& photons;         // in the grids of the lattice
    const std::vector<Photon>& traced;  // those the records are of
    uint64_t seed;
    const std::vector<uint>& visible_lamps;  // of find_visibility()
};

/// What is known of the light of one lamp before, at all nodes, lux for intensity 1.
struct KnownLight {
    uint lamp;
    std::span<const vec3> estimate;  // what its photons around each node say
    std::span<const vec3> seen;  // what rays find there: the estimate, caustics, direct light of a lamp with a surface
};

/// The reflected light of a lamp at all nodes, lux for intensity 1. `progress` is stepped by nodes.
///
/// Rays meet small bright surfaces too seldom: beside a lamp, in a patch of sun. So a ray counts the light of a surface
/// up to a few times the mean of its own patch, and the photons that such a surface reflected bring the rest: each
/// counts by the part of its reflector's light that rays leave out. The two sum up to the whole light.
std::vector<vec3> gather_at_nodes(const GatherInput& input, const KnownLight& known, Progress& progress);

}  // namespace lw
