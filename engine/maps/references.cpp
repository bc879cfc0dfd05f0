#include "maps/references.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "trace/box_search.h"
#include "trace/ray_caster.h"

namespace lw {
namespace {

constexpr size_t chunk_size = 8192;

struct Reference {
    uint map, photon;
};

float largest_of(const std::vector<float>& radii) {
    return radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
}

std::vector<Box> boxes_of(const std::vector<PatchShape>& shapes) {
    std::vector<Box> boxes;
    for (const PatchShape& shape : shapes) boxes.push_back({shape.box_low, shape.box_high});
    return boxes;
}

/// Finds the maps of one photon after another.
class MapFinder {
  public:
    explicit MapFinder(const ReferenceInput& input)
        : in_(input),
          largest_(largest_of(input.radii)),
          cos_angle_(std::cos(glm::radians(input.neighbour_angle_deg))),
          search_(boxes_of(input.shapes)) {}

    /// Appends (map, index) for every map that refers to the photon, its own first.
    void find(const Photon& photon, uint index, std::vector<Reference>& found) const {
        const uint own = in_.patches.of_side[2 * photon.triangle + photon.side()];
        found.push_back({own, index});
        const vec3 normal = normal_of(photon);
        search_.near(photon.position, largest_, [&](uint patch) {
            if (patch != own && belongs(photon.position, normal, patch)) found.push_back({patch, index});
        });
    }

  private:
    vec3 normal_of(const Photon& photon) const {
        const uvec3 c = in_.scene.triangles[photon.triangle];
        const vec3 a = in_.scene.positions[c.x];
        const vec3 product = cross(in_.scene.positions[c.y] - a, in_.scene.positions[c.z] - a);
        const float size = length(product) * (photon.side() ? -1.0f : 1.0f);
        return size != 0 ? product / size : vec3(0);  // zero never passes the angle test
    }

    bool belongs(vec3 position, vec3 normal, uint patch) const {
        const PatchShape& shape = in_.shapes[patch];
        const float cosine = dot(shape.normal, normal), radius = in_.radii[patch];
        if (cosine < cos_angle_) return false;
        const vec3 local = shape.to_local(position);
        const vec3 outside = max(max(shape.low - local, local - shape.high), vec3(0));
        float distance2 = dot(outside, outside);
        if (distance2 > radius * radius) return false;
        if (shape.triangles == 1) distance2 = triangle_distance2(position, shape.triangle);
        const float height = outside.z - 0.01f * largest_;
        const float sine2 = std::max(0.0f, 1 - cosine * cosine) * 1.2f + 1e-4f;
        return distance2 <= radius * radius && (height <= 0 || height * height <= sine2 * distance2);
    }

    float triangle_distance2(vec3 position, uint triangle) const {
        const uvec3 c = in_.scene.triangles[triangle];
        const vec3 d = position - closest_point_on_triangle(position, in_.scene.positions[c.x],
                                                            in_.scene.positions[c.y], in_.scene.positions[c.z]);
        return dot(d, d);
    }

    const ReferenceInput& in_;
    float largest_, cos_angle_;
    BoxSearch search_;
};

}  // namespace

std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor) {
    std::vector<float> radii;
    for (const PatchShape& shape : shapes) {
        const vec3 size = shape.high - shape.low;
        const float perimeter = 2 * (size.x + size.y), area = size.x * size.y;
        const float bound = (-perimeter + std::sqrt(perimeter * perimeter + 4 * 1.1f * lw_pi * area)) / (2 * lw_pi);
        radii.push_back(clamp(bound, std::min(floor, largest), largest));
    }
    return radii;
}

double sample_references(const ReferenceInput& input, size_t samples) {
    const MapFinder finder(input);
    const std::vector<Photon>& photons = input.photons;
    const size_t step = std::max<size_t>(1, photons.size() / samples), count = photons.size() / step;
    std::vector<std::vector<Reference>> chunks((count + 255) / 256);
    parallel_for(chunks.size(), [&](size_t c) {
        for (size_t i = c * 256; i < std::min(c * 256 + 256, count); ++i) finder.find(photons[i * step], 0, chunks[c]);
    });
    size_t found = 0;
    for (const auto& chunk : chunks) found += chunk.size();
    return count ? double(found) / double(count) : 0;
}

References find_references(const ReferenceInput& input) {
    const MapFinder finder(input);
    const std::vector<Photon>& photons = input.photons;
    std::vector<std::vector<Reference>> chunks((photons.size() + chunk_size - 1) / chunk_size);
    Progress progress("references", photons.size());
    parallel_for(chunks.size(), [&](size_t c) {
        const size_t begin = c * chunk_size, end = std::min(begin + chunk_size, photons.size());
        chunks[c].reserve((end - begin) * 5 / 4);
        for (size_t i = begin; i < end; ++i) finder.find(photons[i], uint(i), chunks[c]);
        progress.step(end - begin);
    });
    References result;
    result.starts.assign(input.patches.count + 1, 0);
    for (const auto& chunk : chunks)
        for (const Reference& r : chunk) ++result.starts[r.map + 1];
    for (size_t m = 0; m < input.patches.count; ++m) result.starts[m + 1] += result.starts[m];
    if (result.starts.back() > 0xfffffff0ull)
        throw Error("photon map: more than 2^32 references; use fewer photons or a smaller radius");
    result.photons.resize(result.starts.back());
    std::vector<uint64_t> next(result.starts.begin(), result.starts.end() - 1);
    for (auto& chunk : chunks) {
        for (const Reference& r : chunk) result.photons[next[r.map]++] = r.photon;
        std::vector<Reference>().swap(chunk);
    }
    return result;
}

}  // namespace lw
