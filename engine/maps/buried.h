// Whether a surface lies close under another one, where no light gets.
#pragma once
#include "base/random.h"
#include "trace/ray_caster.h"

namespace lw {

/// Surfaces closer than this under another one get no light.
inline float clearance_of(float scale) { return 0.25f * scale; }

struct BuryingTest {
    float clearance;  // m
    int rays = 4;
    float widest = 1;  // squared sine of the largest angle between a ray and the normal
};

/// True when every ray meets a surface lower than the clearance over the point.
bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, BuryingTest test, Rng& rng);

}  // namespace lw
