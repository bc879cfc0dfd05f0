// Finds which lamps are seen from the surface around each lattice node: from all of it, from none, or from part. A
// gather needs shadow rays only where part of it sees a lamp.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

/// Four bits per node and lamp (some_visible and after in shaders/photon_map.h), visibility_row_length(lamps) numbers
/// per node; the surroundings are the 3 x 3 nodes around, so that narrow shadows are not missed. One ray per node for
/// point, spot and directional lamps, a few for meshes. Nodes without a point have no bits.
std::vector<uint> find_visibility(const Scene& scene, const RayCaster& caster, const Lattice& lattice);

}  // namespace lw
