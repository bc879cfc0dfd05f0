#include "maps/buried.h"

#include <algorithm>

#include "trace/sampling.h"

namespace lw {

bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, BuryingTest test, Rng& rng) {
    const mat3 frame = frame_around(normal);
    const vec3 origin = caster.offset(point, normal);
    for (int i = 0; i < test.rays; ++i) {
        const float u = (float(i) + rng.next()) / float(test.rays) * test.widest;
        const vec3 direction = sample_cosine(u, rng.next());
        if (!caster.nearest(origin, frame * direction, test.clearance / std::max(direction.z, 0.2f))) return false;
    }
    return true;
}

}  // namespace lw
