// Tells whether a point lies so close under another surface that no light gets there.
#pragma once
#include "base/random.h"
#include "trace/ray_caster.h"

namespace lw {

/// The distance, m, below which a surface under another one counts as buried. `radius`: the largest search radius, m.
inline float clearance_of(float radius) { return 0.25f * radius; }

/// True when a point is buried: every one of a few random rays into the hemisphere around `normal` meets a surface at a
/// height of less than `clearance` m over the point.
bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng);

}  // namespace lw
