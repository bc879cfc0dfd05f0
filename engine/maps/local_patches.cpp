#include "maps/local_patches.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <unordered_map>

#include "base/parallel.h"
#include "base/random.h"
#include "maps/surroundings.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float first_cell = 16;     // m
constexpr float most_scales = 12;    // across a group
constexpr vec3 cell_corner{5.92f};   // m, so that planes at round coordinates do not lie between cells
constexpr size_t most_members = 16;  // of a group from which rays look around
constexpr uint rays_of_member = 4;
constexpr uint points_of_triangle = 32, rays_of_point = 8;

/// What the grouping knows of a triangle.
struct TriangleSize {
    vec3 centre;  // of its bounds
    float longest, twice_area;
};

/// A finished group: sides [begin, end) of the order.
struct Leaf {
    size_t begin, end;
    float scale;
};

class Grouping {
  public:
    Grouping(const Scene& scene, const RayCaster& caster)
        : scene_(scene), caster_(caster), sizes_(scene.triangles.size()) {
        parallel_for(
            sizes_.size(),
            [&](size_t t) {
                const auto [a, b, c] = triangle_corners(scene_, t);
                const vec3 low = min(a, min(b, c)), high = max(a, max(b, c)), size = high - low;
                sizes_[t] = {0.5f * (low + high), std::max({size.x, size.y, size.z}), length(edge_product(a, b, c))};
            },
            1024);
    }

    SideGroups group() {
        sort_into_cells();
        std::vector<std::vector<Leaf>> leaves(starts_.size() - 1);
        parallel_for(leaves.size(), [&](size_t g) { divide(starts_[g], starts_[g + 1], first_cell, leaves[g]); });
        SideGroups groups;
        groups.patches.of_side.resize(2 * sizes_.size());
        for (const std::vector<Leaf>& of_cell : leaves)
            for (const Leaf& leaf : of_cell) {
                for (size_t i = leaf.begin; i < leaf.end; ++i) groups.patches.of_side[order_[i]] = groups.patches.count;
                groups.scales.push_back(leaf.scale);
                ++groups.patches.count;
            }
        return groups;
    }

  private:
    struct Key {
        uint object, bin;
        glm::ivec3 cell;
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        size_t operator()(const Key& k) const {
            uint64_t h = mix64((uint64_t(k.object) << 32) | k.bin);
            h = mix64(h ^ uint64_t(uint(k.cell.x)) ^ (uint64_t(uint(k.cell.y)) << 32));
            return size_t(mix64(h ^ uint(k.cell.z)));
        }
    };

    vec3 normal_of(uint side) const {
        const vec3 product = triangle_product(scene_, side / 2);
        const float size = length(product) * (side % 2 ? -1.0f : 1.0f);
        return size != 0 ? product / size : vec3(0, side % 2 ? -1 : 1, 0);
    }

    glm::dvec3 cell_of(vec3 centre, float size) const {
        return floor((scene_.origin + glm::dvec3(centre + cell_corner)) / double(size));
    }

    /// Sorts all sides by object, normal bin and first cell; groups are numbered as they occur.
    void sort_into_cells() {
        std::unordered_map<Key, uint, KeyHash> found;
        std::vector<uint> group(2 * sizes_.size());
        std::vector<uint> counts;
        for (uint side = 0; side < group.size(); ++side) {
            const Key key{scene_.triangle_objects[side / 2], normal_bin(normal_of(side)),
                          glm::ivec3(clamp(cell_of(sizes_[side / 2].centre, first_cell), -1e9, 1e9))};
            group[side] = found.try_emplace(key, uint(counts.size())).first->second;
            if (group[side] == counts.size()) counts.push_back(0);
            ++counts[group[side]];
        }
        starts_.assign(1, 0);
        for (uint count : counts) starts_.push_back(starts_.back() + count);
        std::vector<size_t> next(starts_.begin(), starts_.end() - 1);
        order_.resize(group.size());
        for (uint side = 0; side < group.size(); ++side) order_[next[group[side]]++] = side;
    }

    std::span<uint> sides(size_t begin, size_t end) { return std::span(order_).subspan(begin, end - begin); }

    /// Divides a group that lies in a cell of `size` m, and appends what it becomes.
    void divide(size_t begin, size_t end, float size, std::vector<Leaf>& leaves) {
        begin = part_large(begin, end, size, leaves);
        if (begin == end) return;
        const float scale = rule_.scale_of(distance_of(sides(begin, end)));
        vec3 low(1e30f), high(-1e30f);
        for (uint side : sides(begin, end)) {
            const TriangleSize& t = sizes_[side / 2];
            low = min(low, t.centre - 0.5f * t.longest), high = max(high, t.centre + 0.5f * t.longest);
        }
        const vec3 extent = high - low;
        const float widest = std::min(std::max({extent.x, extent.y, extent.z}), size);
        if (widest <= most_scales * scale) {
            leaves.push_back({begin, end, scale});
            return;
        }
        do size *= 0.5f;
        while (size >= widest);
        divide_cells(begin, end, size, leaves);
    }

    /// Divides a group into cells of `size` m.
    void divide_cells(size_t begin, size_t end, float size, std::vector<Leaf>& leaves) {
        const auto key = [&](uint side) {
            const glm::dvec3 c = cell_of(sizes_[side / 2].centre, size);
            return std::tuple(c.x, c.y, c.z);
        };
        const std::span<uint> all = sides(begin, end);
        std::stable_sort(all.begin(), all.end(), [&](uint x, uint y) { return key(x) < key(y); });
        for (size_t i = begin; i < end;) {
            size_t last = i;
            while (last < end && key(order_[last]) == key(order_[i])) ++last;
            divide(i, last, size, leaves);
            i = last;
        }
    }

    /// Appends the sides that are wider than `size`, each by itself, but needles together, and moves them to the front.
    /// Returns where the others begin.
    size_t part_large(size_t begin, size_t end, float size, std::vector<Leaf>& leaves) {
        const std::span<uint> all = sides(begin, end);
        const auto is_large = [&](uint side) { return sizes_[side / 2].longest > size; };
        const auto is_thin = [&](uint side) {
            return is_needle(sizes_[side / 2].twice_area, sizes_[side / 2].longest, size);
        };
        const auto others = std::stable_partition(all.begin(), all.end(), is_large);
        const auto needles = std::stable_partition(all.begin(), others, [&](uint side) { return !is_thin(side); });
        const size_t first_needle = begin + size_t(needles - all.begin()), first = begin + size_t(others - all.begin());
        for (size_t i = begin; i < first_needle; ++i)
            leaves.push_back({i, i + 1, rule_.scale_of(distance_of_triangle(order_[i]))});
        if (first_needle < first)
            leaves.push_back({first_needle, first, rule_.scale_of(distance_of(sides(first_needle, first)))});
        return first;
    }

    /// How far the surroundings of a group are, from some of its members.
    float distance_of(std::span<const uint> members) const {
        const size_t count = std::min(members.size(), most_members);
        double area = 0;
        for (uint side : members) area += double(sizes_[side / 2].twice_area);
        std::vector<LookOut> points;
        std::vector<vec3> places;
        double passed = 0;
        for (size_t m = 0; m < members.size() && points.size() < count; ++m) {
            const uint side = members[m];
            passed += double(sizes_[side / 2].twice_area);
            if (passed < (double(points.size()) + 0.5) / double(count) * area) continue;  // spread by area
            const std::array<vec3, 3> p = triangle_corners(scene_, side / 2);
            points.push_back({(p[0] + p[1] + p[2]) / 3.0f, normal_of(side), lift_above(p)});
            places.push_back(points.back().position);
        }
        const uint rays = count < 4 ? 4 * rays_of_member : rays_of_member;
        return look_around(caster_, points, rays, seed_of(scene_.origin, places)).distance;
    }

    /// The same of a large triangle, from points all over it.
    float distance_of_triangle(uint side) const {
        const std::array<vec3, 3> p = triangle_corners(scene_, side / 2);
        const uint64_t seed = seed_of(scene_.origin, p) + side % 2;
        std::vector<LookOut> points;
        for (uint i = 0; i < points_of_triangle; ++i) {
            const vec2 at = sample_triangle(sobol_owen(i, 0, uint32_t(seed)), sobol_owen(i, 1, uint32_t(seed)));
            points.push_back({(1 - at.x - at.y) * p[0] + at.x * p[1] + at.y * p[2], normal_of(side), lift_above(p)});
        }
        return look_around(caster_, points, rays_of_point, seed).distance;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const ScaleRule rule_{scene_};
    std::vector<TriangleSize> sizes_;
    std::vector<uint> order_;     // sides, by groups
    std::vector<size_t> starts_;  // of the groups in it
};

}  // namespace

ScaledPatches find_local_patches(const Scene& scene, const RayCaster& caster) {
    SideGroups sheets = split_sheets(scene, Grouping(scene, caster).group());
    std::vector<PatchShape> shapes = shapes_of(scene, sheets.patches);
    return {std::move(sheets.patches), std::move(shapes), std::move(sheets.scales)};
}

}  // namespace lw
