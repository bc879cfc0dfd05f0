// Builds the hierarchy that rays in compute shaders traverse, with Embree's builder (surface area heuristic).
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"

namespace lw {

/// Hierarchy over all triangles with positive area, at most 4 per leaf; empty without lamps.
/// Throws Error when there is not enough memory. Deterministic.
Bvh build_bvh(const Scene& scene);

}  // namespace lw
