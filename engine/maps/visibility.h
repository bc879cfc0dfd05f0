// Which lamps the surface around each lattice node sees: all of it, none, or part. Only where part of it does must a
// gather trace shadow rays.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// Four bits per node and lamp (some_visible and after in shaders/photon_map.h), visibility_words(lamps) words per
/// node; the surroundings are the 3 x 3 nodes around, so that narrow shadows are not missed. One ray per node for
/// point, spot and directional lamps, a few for meshes. Nodes without a point have no bits.
std::vector<uint> find_visibility(const Scene& scene, const RayCaster& caster, const Lattice& lattice);

}  // namespace lw
