#include "maps/coverage_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "maps/buried.h"
#include "maps/surroundings.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double samples_of_patch = 64;
constexpr double max_samples_of_patch = 2e6;
// Of the square of a radius; on curved patches, whose coverage has no closed form anywhere, the smallest kernel needs
// more than seven samples.
constexpr float area_of_sample = 0.03f, area_on_curved = 0.01f;

bool is_curved(const PatchShape& shape) { return shape.cos_spread < 0.999f; }
constexpr float least_of_own = 0.4f;  // radius that samples are made for, else too many lie in wide kernels

/// A triangle, or a part of one, on one side of a surface, all on one patch.
struct Plot {
    std::array<vec3, 3> corners;
    uint side, patch;
    uint samples = 0;

    float area() const { return 0.5f * length(edge_product(corners[0], corners[1], corners[2])); }
};

using Polygon = std::vector<vec3>;

/// The part of a convex polygon on the front of a cut, or on its back.
Polygon part_of(const Polygon& polygon, const Cut& cut, bool front) {
    Polygon part;
    const auto height = [&](vec3 p) { return dot(p - cut.point, cut.normal) * (front ? 1.0f : -1.0f); };
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const float hp = height(p), hq = height(q);
        if (hp >= 0) part.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) part.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    return part;
}

/// Appends the plots of a polygon on a side whose patch or cut is `id`.
void add_plots(const Patches& patches, uint side, uint id, const Polygon& polygon, std::vector<Plot>& plots) {
    if (polygon.size() < 3) return;
    if (is_cut(id)) {
        const Cut& cut = patches.cuts[id & ~cut_bit];
        add_plots(patches, side, cut.front, part_of(polygon, cut, true), plots);
        add_plots(patches, side, cut.back, part_of(polygon, cut, false), plots);
        return;
    }
    for (size_t i = 2; i < polygon.size(); ++i) plots.push_back({{polygon[0], polygon[i - 1], polygon[i]}, side, id});
}

/// All plots on patches near which samples are wanted; the areas of all patches, and the area that a sample on each
/// stands for, m2, which is 0 where none is wanted.
struct Plots {
    explicit Plots(const Scene& scene, const WantedSamples& wanted) : shares(wanted.partition.patches.count, 0.0f) {
        const Patches& patches = wanted.partition.patches;
        for (uint p = 0; p < patches.count; ++p)
            shares[p] = (is_curved(wanted.partition.shapes[p]) ? area_on_curved : area_of_sample) *
                        wanted.least_radius(p) * wanted.least_radius(p);
        for (size_t side = 0; side < patches.of_side.size(); ++side) {
            const uint id = patches.of_side[side];
            if (!is_cut(id) && shares[id] <= 0) continue;
            const auto [a, b, c] = triangle_corners(scene, side / 2);
            const size_t first = all.size();
            add_plots(patches, uint(side), id, {a, b, c}, all);
            if (is_cut(id))
                all.erase(std::remove_if(all.begin() + int64_t(first), all.end(),
                                         [&](const Plot& plot) { return shares[plot.patch] <= 0; }),
                          all.end());
        }
        count_samples();
    }

    std::vector<Plot> all;
    std::vector<float> shares;

  private:
    void count_samples() {
        std::vector<double> areas(shares.size(), 0), waiting(shares.size(), 0.5);
        for (const Plot& plot : all) areas[plot.patch] += double(plot.area());
        for (size_t p = 0; p < shares.size(); ++p)
            shares[p] = float(std::clamp(double(shares[p]), std::max(1e-20, areas[p] / max_samples_of_patch),
                                         std::max(1e-20, areas[p] / samples_of_patch)));
        for (Plot& plot : all) {
            double& left = waiting[plot.patch];
            left += double(plot.area()) / double(shares[plot.patch]);
            plot.samples = uint(left);
            left -= plot.samples;
        }
    }
};

/// True when another triangle lies in the same place and is the one that rays meet there: it holds the photons, and
/// only its samples count. Without this, duplicate or overlapping triangles would be dark: more area, not more photons.
bool is_overlaid(const RayCaster& caster, vec3 point, vec3 normal, uint triangle) {
    const std::optional<Hit> hit = caster.nearest(caster.offset(point, normal), -normal, 2 * caster.epsilon());
    return hit && hit->triangle != triangle;
}

/// The samples of a plot.
void sample_plot(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted, const Plot& plot,
                 float share, std::vector<Photon>& samples) {
    const auto& [p0, p1, p2] = plot.corners;
    const vec3 product = edge_product(p0, p1, p2) * (plot.side % 2 ? -1.0f : 1.0f), normal = normalize(product);
    const uint64_t seed = seed_of(scene.origin, plot.corners) + plot.side % 2;
    const float clearance = clearance_of(wanted.partition.scales[plot.patch]);
    for (uint i = 0; i < plot.samples; ++i) {
        const vec2 place = sample_triangle(sobol_owen(i, 0, uint32_t(seed)), sobol_owen(i, 1, uint32_t(seed)));
        const vec3 position = (1 - place.x - place.y) * p0 + place.x * p1 + place.y * p2;
        if (!wanted.neighbourhoods.contain(position) || !wanted.contain(plot.patch, position)) continue;
        if (is_overlaid(caster, position, normal, plot.side / 2)) continue;
        Rng rng(1, seed, i);
        if (is_buried(caster, position, normal, {clearance}, rng)) continue;
        samples.push_back(
            {position, vec3(share), normal, plot.side / 2, pack_origin(0, path_direct, plot.side % 2 != 0)});
    }
}

}  // namespace

uint64_t Neighbourhoods::bit_of(vec3 cell, int level) {
    const uint64_t x = uint64_t(uint32_t(int(cell.x))), y = uint64_t(uint32_t(int(cell.y))), z = uint64_t(int(cell.z));
    return (mix64((x << 32 | y) ^ z * 0x9e3779b97f4a7c15ull) + uint64_t(level + 128) * 0x9e3779b9ull) % bit_count;
}

void Neighbourhoods::add(vec3 point, float radius) {
    const int level = int(std::ceil(std::log2(radius)));
    if (std::find(levels_.begin(), levels_.end(), level) == levels_.end()) levels_.push_back(level);
    const float size = std::ldexp(1.0f, level);  // at least as wide as the radius
    const vec3 low = floor(point / size) - 1.0f, high = floor(point / size) + 1.0f;
    for (float z = low.z; z <= high.z; ++z)
        for (float y = low.y; y <= high.y; ++y)
            for (float x = low.x; x <= high.x; ++x) {
                const uint64_t bit = bit_of({x, y, z}, level);
                bits_[bit / 64] |= 1ull << bit % 64;
            }
}

bool Neighbourhoods::contain(vec3 point) const {
    return std::any_of(levels_.begin(), levels_.end(), [&](int level) {
        const uint64_t bit = bit_of(floor(point * std::ldexp(1.0f, -level)), level);
        return (bits_[bit / 64] >> bit % 64 & 1) != 0;
    });
}

bool WantedSamples::contain(uint patch, vec3 position) const {
    const auto near = partition.neighbours.near(patch, position);
    return is_wanted[patch] || std::any_of(near.begin(), near.end(), [&](uint p) { return is_wanted[p]; });
}

float WantedSamples::least_radius(uint patch) const {
    float least = is_wanted[patch] ? partition.radii[patch] : 1e30f;
    for (uint p : partition.neighbours.of(patch))
        if (is_wanted[p]) least = std::min(least, partition.radii[p]);
    return least < 1e30f ? std::max(least, least_of_own * partition.radii[patch]) : 0.0f;
}

std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted) {
    constexpr size_t chunk = 1024;
    const Plots plots(scene, wanted);
    std::vector<std::vector<Photon>> chunks((plots.all.size() + chunk - 1) / chunk);
    parallel_for(chunks.size(), [&](size_t k) {
        for (size_t i = k * chunk; i < std::min(plots.all.size(), (k + 1) * chunk); ++i)
            sample_plot(scene, caster, wanted, plots.all[i], plots.shares[plots.all[i].patch], chunks[k]);
    });
    std::vector<Photon> samples;
    samples.reserve(std::accumulate(chunks.begin(), chunks.end(), size_t(0),
                                    [](size_t sum, const std::vector<Photon>& part) { return sum + part.size(); }));
    for (const auto& part : chunks) samples.insert(samples.end(), part.begin(), part.end());
    return samples;
}

}  // namespace lw
