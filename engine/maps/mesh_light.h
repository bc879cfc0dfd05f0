// The direct light of lamps with a surface at the nodes of the lattices: their shadows are soft, so nodes can hold it.
#pragma once
#include <vector>

#include "maps/lattice.h"
#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

/// Irradiance of one such lamp at all nodes, lux for intensity 1: in closed form where all of the lamp is seen, by
/// shadow rays where `visible_lamps` (of find_visibility()) says that some of it is hidden.
std::vector<vec3> find_mesh_light(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
                                  const std::vector<uint>& visible_lamps, uint lamp);

}  // namespace lw
