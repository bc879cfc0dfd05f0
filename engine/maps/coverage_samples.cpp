#include "maps/coverage_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "maps/buried.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double samples_of_patch = 64;
constexpr float plane_spread = 0.999f;  // least cosine between normals of a plane patch

/// The area a sample of each triangle stands for: at most `area`, a third of it on curved patches, whose coverage has
/// no closed form anywhere; and a patch has at least samples_of_patch.
std::vector<float> areas_of_samples(const Scene& scene, const Partition& partition, float area) {
    const Patches& patches = partition.patches;
    const auto is_curved = [&](size_t side) {
        const uint id = patches.of_side[side];
        return !is_cut(id) && partition.shapes[id].cos_spread < plane_spread;
    };
    std::vector<double> patch_areas(patches.count, 0),
        cut_areas(patches.cuts.size(), 0);  // of the whole when it is cut
    const auto area_of_side = [&](size_t side) -> double& {
        const uint id = patches.of_side[side];
        return is_cut(id) ? cut_areas[id & ~cut_bit] : patch_areas[id];
    };
    for (size_t t = 0; t < scene.triangles.size(); ++t)
        for (size_t side = 2 * t; side < 2 * t + 2; ++side) area_of_side(side) += triangle_area(scene, t);
    std::vector<float> areas(scene.triangles.size());
    for (size_t t = 0; t < areas.size(); ++t) {
        const double smaller = std::min(area_of_side(2 * t), area_of_side(2 * t + 1));
        const float wanted = is_curved(2 * t) || is_curved(2 * t + 1) ? area / 3 : area;
        areas[t] = std::max(1e-20f, std::min(wanted, float(smaller / samples_of_patch)));
    }
    return areas;
}

/// True when another triangle lies in the same place and is the one that rays meet there: it holds the photons, and
/// only its samples count. Without this, duplicate or overlapping triangles would be dark: more area, not more photons.
bool is_overlaid(const RayCaster& caster, vec3 point, vec3 normal, uint triangle) {
    const std::optional<Hit> hit = caster.nearest(caster.offset(point, normal), -normal, 2 * caster.epsilon());
    return hit && hit->triangle != triangle;
}

}  // namespace

uint64_t Neighbourhoods::bit_of(vec3 cell) const {
    const uint64_t x = uint64_t(uint32_t(int(cell.x))), y = uint64_t(uint32_t(int(cell.y))), z = uint64_t(int(cell.z));
    return mix64((x << 32 | y) ^ z * 0x9e3779b97f4a7c15ull) % bit_count;
}

void Neighbourhoods::add(vec3 point) {
    const vec3 low = floor(point / radius_) - 1.0f,
               high = floor(point / radius_) + 1.0f;  // cells as wide as the radius
    for (float z = low.z; z <= high.z; ++z)
        for (float y = low.y; y <= high.y; ++y)
            for (float x = low.x; x <= high.x; ++x) {
                const uint64_t bit = bit_of({x, y, z});
                bits_[bit / 64] |= 1ull << bit % 64;
            }
}

bool Neighbourhoods::contain(vec3 point) const {
    const uint64_t bit = bit_of(floor(point / radius_));
    return bits_[bit / 64] >> bit % 64 & 1;
}

bool WantedSamples::contain(size_t side, vec3 position) const {
    const uint own = partition.patches.at(side, position);
    const auto near = partition.neighbours.near(own, position);
    return is_wanted[own] || std::any_of(near.begin(), near.end(), [&](uint patch) { return is_wanted[patch]; });
}

std::vector<char> WantedSamples::sides() const {
    const Patches& patches = partition.patches;
    std::vector<char> near(patches.count), wanted;
    for (uint patch = 0; patch < patches.count; ++patch) {
        const auto all = partition.neighbours.of(patch);
        near[patch] = is_wanted[patch] || std::any_of(all.begin(), all.end(), [&](uint p) { return is_wanted[p]; });
    }
    for (uint patch : patches.of_side) wanted.push_back(is_cut(patch) || near[patch]);  // a cut: its pieces
    return wanted;
}

std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted,
                                    SampleSettings settings) {
    constexpr size_t chunk = 1024;
    const std::vector<float> shares = areas_of_samples(scene, wanted.partition, settings.area);
    const std::vector<char> sides = wanted.sides();
    std::vector<uint> counts(scene.triangles.size());
    double waiting = 0.5;
    for (size_t t = 0; t < counts.size(); ++t) {
        waiting += triangle_area(scene, t) / double(shares[t]);
        counts[t] = uint(waiting);
        waiting -= counts[t];
    }
    std::vector<std::vector<Photon>> chunks((counts.size() + chunk - 1) / chunk);
    parallel_for(chunks.size(), [&](size_t k) {
        for (size_t t = k * chunk; t < std::min(counts.size(), (k + 1) * chunk); ++t) {
            if (!sides[2 * t] && !sides[2 * t + 1]) continue;
            const auto scramble = uint32_t(mix64(t));
            const auto [p0, p1, p2] = triangle_corners(scene, t);
            const vec3 product = edge_product(p0, p1, p2);
            for (uint i = 0; i < counts[t]; ++i) {
                const vec2 place = sample_triangle(sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
                const vec3 position = (1 - place.x - place.y) * p0 + place.x * p1 + place.y * p2;
                if (!wanted.neighbourhoods.contain(position)) continue;
                const bool wanted_sides[] = {wanted.contain(2 * t, position), wanted.contain(2 * t + 1, position)};
                if (!wanted_sides[0] && !wanted_sides[1]) continue;
                if (is_overlaid(caster, position, normalize(product), uint(t))) continue;
                for (uint side = 0; side < 2; ++side) {
                    if (!wanted_sides[side]) continue;
                    const vec3 n = product / (side ? -length(product) : length(product));
                    Rng rng(1, 2 * t + side, i);
                    if (is_buried(caster, position, n, {settings.clearance}, rng)) continue;
                    chunks[k].push_back({position, vec3(shares[t]), n, uint(t), pack_origin(0, path_direct, side)});
                }
            }
        }
    });
    std::vector<Photon> samples;
    samples.reserve(std::accumulate(chunks.begin(), chunks.end(), size_t(0),
                                    [](size_t sum, const std::vector<Photon>& part) { return sum + part.size(); }));
    for (const auto& part : chunks) samples.insert(samples.end(), part.begin(), part.end());
    return samples;
}

}  // namespace lw
