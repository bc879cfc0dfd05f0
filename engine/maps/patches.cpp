#include "maps/patches.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/random.h"

namespace lw {
namespace {

/// Face of the cube and 3 x 3 sub-bin that a direction points at; axis-aligned normals lie in bin centres.
uint normal_bin(vec3 n) {
    const vec3 a = abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const float major = std::max(a[axis], 1e-20f);
    const auto bin = [&](int other) { return uint(clamp(int(std::floor((n[other] / major * 0.5f + 0.5f) * 3)), 0, 2)); };
    return (uint(axis) * 2 + (n[axis] < 0 ? 1 : 0)) * 9 + bin((axis + 1) % 3) * 3 + bin((axis + 2) % 3);
}

struct PatchKey {
    uint object, bin;
    glm::ivec3 cell;
    bool operator==(const PatchKey&) const = default;
};

struct PatchKeyHash {
    size_t operator()(const PatchKey& k) const {
        uint64_t h = mix64((uint64_t(k.object) << 32) | k.bin);
        h = mix64(h ^ uint64_t(uint(k.cell.x)) ^ (uint64_t(uint(k.cell.y)) << 32));
        return size_t(mix64(h ^ uint(k.cell.z)));
    }
};

}  // namespace

Patches group_triangles(const Scene& scene, float patch_size) {
    Patches patches;
    patches.of_side.resize(2 * scene.triangles.size());
    std::unordered_map<PatchKey, uint, PatchKeyHash> shared;
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const uvec3 corner = scene.triangles[t];
        const vec3 a = scene.positions[corner.x], b = scene.positions[corner.y], c = scene.positions[corner.z];
        const vec3 low = min(a, min(b, c)), high = max(a, max(b, c)), size = high - low;
        const vec3 product = cross(b - a, c - a);
        const float twice_area = length(product);
        const vec3 normal = twice_area > 0 ? product / twice_area : vec3(0, 1, 0);
        for (uint side = 0; side < 2; ++side) {
            uint& patch = patches.of_side[2 * t + side];
            if (std::max({size.x, size.y, size.z}) > patch_size) {
                patch = patches.count++;
                continue;
            }
            const vec3 cell = floor(0.5f * (low + high) / patch_size + 0.37f);
            const PatchKey key{scene.triangle_objects[t], normal_bin(side ? -normal : normal), glm::ivec3(cell)};
            const auto [place, fresh] = shared.try_emplace(key, patches.count);
            if (fresh) ++patches.count;
            patch = place->second;
        }
    }
    return patches;
}

}  // namespace lw
