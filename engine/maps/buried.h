// Whether a surface lies close under another one, where no light gets.
#pragma once
#include "base/random.h"
#include "trace/ray_caster.h"

namespace lw {

/// Surfaces closer than this under another one get no light.
inline float clearance_of(float radius) { return 0.25f * radius; }

/// True when every one of a few rays into the hemisphere meets a surface lower than `clearance` over the point.
bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng);

}  // namespace lw
