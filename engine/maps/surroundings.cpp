#include "maps/surroundings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float nothing_met = 1e30f;
constexpr float scale_in_distances = 0.15f;
constexpr float scale_in_width = 0.5f;                    // the largest, of the width of a patch
constexpr float least_scale = 0.25f, largest_scale = 16;  // m
constexpr float in_sizes = 0.05f;                         // of a scene smaller than a room, or wider than a town
constexpr float root_of_2 = 1.41421356f;
constexpr float least_of_median = 0.4f;  // points closer to something than this part of the median count as that close

/// The largest power of two that is no more than `value`.
float power_below(float value) { return value > 0 ? std::exp2(std::floor(std::log2(value))) : 0.0f; }

}  // namespace

Surroundings look_around(const RayCaster& caster, std::span<const LookOut> points, uint rays, uint64_t seed) {
    std::vector<float> met, nearness;  // 1 / m, of each point: over the rays that met something, and over all
    uint missed = 0;
    for (size_t p = 0; p < points.size(); ++p) {
        const mat3 frame = frame_around(points[p].normal);
        const vec3 origin = points[p].position + points[p].normal * points[p].lift;
        const auto scramble = uint32_t(mix64(seed + p));
        float sum = 0;
        uint hits = 0;
        for (uint i = 0; i < rays; ++i) {
            const vec3 direction = sample_cosine(sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
            const std::optional<Hit> hit = caster.nearest(origin, frame * direction);
            if (hit) sum += 1 / std::max(hit->distance, 1e-30f), ++hits;
        }
        if (hits > 0) met.push_back(sum / float(hits));
        nearness.push_back(sum / float(rays));
        missed += rays - hits;
    }
    if (met.empty()) return {nothing_met, 1, 1};
    std::sort(met.begin(), met.end());
    std::sort(nearness.begin(), nearness.end());
    const float most = met[met.size() / 2] / least_of_median;
    float sum = 0;
    for (float near : met) sum += std::min(near, most);
    const size_t extreme = nearness.size() / 8;
    const float spread = nearness[nearness.size() - 1 - extreme] / std::max(nearness[extreme], 1 / nothing_met);
    return {float(met.size()) / sum, float(missed) / float(rays * points.size()), spread};
}

float lift_above(const std::array<vec3, 3>& corners) {
    const vec3 reach = max(abs(corners[0]), max(abs(corners[1]), abs(corners[2])));
    return 4e-6f * std::max({reach.x, reach.y, reach.z});
}

uint64_t seed_of(const glm::dvec3& origin, std::span<const vec3> places) {
    constexpr double steps = 1024, between = 0.37;  // per m; round coordinates lie within a step
    uint64_t hash = 0;
    for (const vec3& place : places)
        for (int c = 0; c < 3; ++c)
            hash =
                mix64(hash ^ uint64_t(int64_t(clamp((origin[c] + double(place[c])) * steps + between, -1e18, 1e18))));
    return hash;
}

ScaleRule::ScaleRule(const Scene& scene)
    : least_(power_below(std::min(least_scale, in_sizes * scene.size()))),
      largest_(std::max(largest_scale, 2 * power_below(in_sizes * scene.size()))) {}

float ScaleRule::scale_of(float distance) const {
    return clamp(power_below(root_of_2 * scale_in_distances * distance), least_, largest_);
}

float ScaleRule::at_most(float scale, float width) const {
    return std::min(scale, std::max(power_below(scale_in_width * width), least_));
}

}  // namespace lw
