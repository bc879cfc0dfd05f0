#include "maps/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "base/parallel.h"
#include "base/random.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr float gap_in_scales = 0.024f;  // heights further apart than this are two sheets

struct PatchKey {
    uint object, bin;
    int level;  // 0, or log2 of the size of the cells of needles
    glm::ivec3 cell;
    bool operator==(const PatchKey&) const = default;
};

struct PatchKeyHash {
    size_t operator()(const PatchKey& k) const {
        uint64_t h = mix64((uint64_t(k.object) << 32) | k.bin);
        h = mix64(h ^ uint64_t(uint(k.cell.x)) ^ (uint64_t(uint(k.cell.y)) << 32));
        return size_t(mix64(h ^ uint(k.cell.z) ^ (uint64_t(uint(k.level)) << 32)));
    }
};

/// The range of heights of a triangle side along the mean normal of its group, m.
struct HeightSpan {
    uint group, side;
    float low, high;
};

}  // namespace

uint normal_bin(vec3 n) {
    const vec3 a = abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const float major = std::max(a[axis], 1e-20f);
    const auto bin = [&](int other) {
        return uint(clamp(int(std::floor((n[other] / major * 0.5f + 0.5f) * 3)), 0, 2));
    };
    return (uint(axis) * 2 + (n[axis] < 0 ? 1 : 0)) * 9 + bin((axis + 1) % 3) * 3 + bin((axis + 2) % 3);
}

SideGroups split_sheets(const Scene& scene, const SideGroups& grouped) {
    const Patches& groups = grouped.patches;
    std::vector<glm::dvec3> normals(groups.count, glm::dvec3(0));
    std::vector<HeightSpan> spans(groups.of_side.size());
    const auto corners = [&](size_t side) { return triangle_corners(scene, side / 2); };
    for (size_t side = 0; side < spans.size(); ++side) {
        const glm::dvec3 product(triangle_product(scene, side / 2));
        normals[groups.of_side[side]] += side % 2 ? -product : product;
    }
    for (glm::dvec3& n : normals) n = glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0, 1, 0);
    for (size_t side = 0; side < spans.size(); ++side) {
        const uint group = groups.of_side[side];
        const auto [a, b, c] = corners(side);
        const vec3 n(normals[group]);
        const float ha = dot(n, a), hb = dot(n, b), hc = dot(n, c);
        spans[side] = {group, uint(side), std::min({ha, hb, hc}), std::max({ha, hb, hc})};
    }
    parallel_sort(spans.begin(), spans.end(), [](const HeightSpan& x, const HeightSpan& y) {
        return std::tie(x.group, x.low, x.side) < std::tie(y.group, y.low, y.side);
    });
    SideGroups sheets;
    sheets.patches.of_side.resize(spans.size());
    float top = 0;
    for (size_t i = 0; i < spans.size(); ++i) {
        const float scale = grouped.scales[spans[i].group];
        const bool fresh = i == 0 || spans[i].group != spans[i - 1].group || spans[i].low > top + gap_in_scales * scale;
        if (fresh) ++sheets.patches.count, sheets.scales.push_back(scale);
        top = fresh ? spans[i].high : std::max(top, spans[i].high);
        sheets.patches.of_side[spans[i].side] = sheets.patches.count - 1;
    }
    return sheets;
}

Patches group_triangles(const Scene& scene, float patch_size) {
    Patches patches;
    patches.of_side.resize(2 * scene.triangles.size());
    std::unordered_map<PatchKey, uint, PatchKeyHash> shared;
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const auto [a, b, c] = triangle_corners(scene, t);
        const vec3 low = min(a, min(b, c)), high = max(a, max(b, c)), size = high - low;
        const vec3 product = edge_product(a, b, c);
        const float twice_area = length(product);
        const vec3 normal = twice_area > 0 ? product / twice_area : vec3(0, 1, 0);
        for (uint side = 0; side < 2; ++side) {
            uint& patch = patches.of_side[2 * t + side];
            const float longest = std::max({size.x, size.y, size.z});
            const bool needle = longest > patch_size && is_needle(twice_area, longest, patch_size);
            if (longest > patch_size && !needle) {
                patch = patches.count++;
                continue;
            }
            const int level = needle ? int(std::ceil(std::log2(longest / patch_size))) : 0;
            const vec3 cell = floor(0.5f * (low + high) / std::ldexp(patch_size, level) + 0.37f);
            const PatchKey key{scene.triangle_objects[t], normal_bin(side ? -normal : normal), level, glm::ivec3(cell)};
            const auto [place, fresh] = shared.try_emplace(key, patches.count);
            if (fresh) ++patches.count;
            patch = place->second;
        }
    }
    const std::vector<float> scales(patches.count, patch_size / patch_size_in_scales);
    return split_sheets(scene, {std::move(patches), scales}).patches;
}

namespace {

/// Calls visit(patch shape, corners, product of edges turned to the side) for both sides of every triangle.
template <class Visit>
void for_each_side(const Scene& scene, const Patches& patches, std::vector<PatchShape>& shapes, const Visit& visit) {
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const std::array<vec3, 3> p = triangle_corners(scene, t);
        const vec3 product = edge_product(p[0], p[1], p[2]);
        for (uint side = 0; side < 2; ++side)
            visit(patches.of_side[2 * t + side], uint(t), p, side ? -product : product, shapes);
    }
}

struct FrameSum {
    glm::dvec3 normal{0};
    vec3 edge{0};
    float longest = -1;
};

void set_axes(PatchShape& shape, const FrameSum& sum) {
    const double size = glm::length(sum.normal);
    shape.normal = size > 0 ? vec3(sum.normal / size) : vec3(0, 1, 0);
    vec3 u = sum.edge - shape.normal * dot(sum.edge, shape.normal);
    if (!(length(u) > 1e-6f * std::max(sum.longest, 1e-30f)))
        u = cross(shape.normal, std::abs(shape.normal.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 0, 1));
    shape.u_axis = normalize(u);
    shape.v_axis = cross(shape.normal, shape.u_axis);
    shape.low = shape.box_low = vec3(1e30f);
    shape.high = shape.box_high = vec3(-1e30f);
}

}  // namespace

std::vector<PatchShape> shapes_of(const Scene& scene, const Patches& patches) {
    std::vector<PatchShape> shapes(patches.count);
    std::vector<FrameSum> sums(patches.count);
    for_each_side(scene, patches, shapes, [&](uint patch, uint t, const std::array<vec3, 3>& p, vec3 product, auto&) {
        FrameSum& sum = sums[patch];
        sum.normal += glm::dvec3(product);
        shapes[patch].triangle = t;
        ++shapes[patch].triangles;
        for (size_t e = 0; e < 3; ++e) {
            const vec3 edge = p[(e + 1) % 3] - p[e];
            if (length(edge) <= sum.longest) continue;
            sum.longest = length(edge);
            sum.edge = edge;
            shapes[patch].anchor = p[e];
        }
    });
    for (uint patch = 0; patch < patches.count; ++patch) set_axes(shapes[patch], sums[patch]);
    for_each_side(scene, patches, shapes,
                  [](uint patch, uint, const std::array<vec3, 3>& p, vec3 product, std::vector<PatchShape>& all) {
                      PatchShape& shape = all[patch];
                      const float size = length(product);
                      if (size > 0) shape.cos_spread = std::min(shape.cos_spread, dot(product / size, shape.normal));
                      for (const vec3& corner : p) {
                          const vec3 local = shape.to_local(corner);
                          shape.low = min(shape.low, local), shape.high = max(shape.high, local);
                          shape.box_low = min(shape.box_low, corner), shape.box_high = max(shape.box_high, corner);
                      }
                  });
    return shapes;
}

}  // namespace lw
