// Builds the shadow rays' hierarchy with Embree's surface area heuristic builder.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"

namespace lw {

/// Hierarchy over all triangles with positive area, at most 4 per leaf; empty without lamps.
/// Throws Error when there is not enough memory. Deterministic.
Bvh build_bvh(const Scene& scene);

}  // namespace lw
