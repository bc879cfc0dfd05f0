#include "maps/buried.h"

#include <algorithm>

#include "trace/sampling.h"

namespace lw {

bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng) {
    constexpr int rays_around = 4;
    const mat3 frame = frame_around(normal);
    const vec3 origin = caster.offset(point, normal);
    for (int i = 0; i < rays_around; ++i) {
        const float u = (float(i) + rng.next()) / rays_around;
        const vec3 direction = sample_cosine(u, rng.next());
        if (!caster.nearest(origin, frame * direction, clearance / std::max(direction.z, 0.2f))) return false;
    }
    return true;
}

}  // namespace lw
