#include "maps/references.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace lw {
namespace {

constexpr size_t chunk_size = 8192;

struct Reference {
    uint map, photon;
};

/// Finds the maps of one photon after another.
class MapFinder {
  public:
    MapFinder(const Scene& scene, const RayCaster& caster, const Patches& patches, const BakeSettings& settings)
        : scene_(scene), caster_(caster), patches_(patches), radius_(settings.radius),
          cos_angle_(std::cos(glm::radians(settings.neighbour_angle_deg))) {
        for (size_t t = 0; t < scene.triangles.size(); ++t) normals_.push_back(normal_of(t));
    }

    /// Appends (map, index) for every map that refers to the photon, its own first, each once.
    void find(const Photon& photon, uint index, std::vector<Reference>& found) const {
        const size_t first = found.size();
        found.push_back({patches_.of_side[2 * photon.triangle + photon.side()], index});
        const vec3 normal = photon.side() ? -normals_[photon.triangle] : normals_[photon.triangle];
        caster_.triangles_near(photon.position, radius_, [&](uint triangle) {
            const float cosine = dot(normals_[triangle], normal);
            if (abs(cosine) < cos_angle_) return;
            const uint map = patches_.of_side[2 * triangle + (cosine < 0 ? 1 : 0)];
            for (size_t i = first; i < found.size(); ++i)
                if (found[i].map == map) return;
            if (belongs(photon.position, triangle, cosine)) found.push_back({map, index});
        });
    }

  private:
    vec3 normal_of(size_t t) const {
        const uvec3 c = scene_.triangles[t];
        const vec3 product = cross(scene_.positions[c.y] - scene_.positions[c.x], scene_.positions[c.z] - scene_.positions[c.x]);
        const float twice_area = length(product);
        return twice_area > 0 ? product / twice_area : vec3(0);  // zero never passes the angle test
    }

    bool belongs(vec3 position, uint triangle, float cosine) const {
        const uvec3 c = scene_.triangles[triangle];
        const vec3 a = scene_.positions[c.x];
        const vec3 d = closest_point_on_triangle(position, a, scene_.positions[c.y], scene_.positions[c.z]) - position;
        const float distance2 = dot(d, d);
        if (distance2 > radius_ * radius_) return false;
        const float height = abs(dot(position - a, normals_[triangle])) - 0.01f * radius_;
        const float sine2 = std::max(0.0f, 1 - cosine * cosine) * 1.2f + 1e-4f;
        return height <= 0 || height * height <= sine2 * distance2;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const Patches& patches_;
    float radius_, cos_angle_;
    std::vector<vec3> normals_;
};

}  // namespace

double sample_references(const Scene& scene, const RayCaster& caster, const std::vector<Photon>& photons,
                         const Patches& patches, const BakeSettings& settings, size_t samples) {
    const MapFinder finder(scene, caster, patches, settings);
    const size_t step = std::max<size_t>(1, photons.size() / samples), count = photons.size() / step;
    std::vector<std::vector<Reference>> chunks((count + 255) / 256);
    parallel_for(chunks.size(), [&](size_t c) {
        for (size_t i = c * 256; i < std::min(c * 256 + 256, count); ++i) finder.find(photons[i * step], 0, chunks[c]);
    });
    size_t found = 0;
    for (const auto& chunk : chunks) found += chunk.size();
    return count ? double(found) / double(count) : 0;
}

References find_references(const Scene& scene, const RayCaster& caster, const std::vector<Photon>& photons,
                           const Patches& patches, const BakeSettings& settings) {
    const MapFinder finder(scene, caster, patches, settings);
    std::vector<std::vector<Reference>> chunks((photons.size() + chunk_size - 1) / chunk_size);
    Progress progress("references", photons.size());
    parallel_for(chunks.size(), [&](size_t c) {
        const size_t begin = c * chunk_size, end = std::min(begin + chunk_size, photons.size());
        chunks[c].reserve((end - begin) * 5 / 4);
        for (size_t i = begin; i < end; ++i) finder.find(photons[i], uint(i), chunks[c]);
        progress.step(end - begin);
    });
    References result;
    result.starts.assign(patches.count + 1, 0);
    for (const auto& chunk : chunks)
        for (const Reference& r : chunk) ++result.starts[r.map + 1];
    for (size_t m = 0; m < patches.count; ++m) result.starts[m + 1] += result.starts[m];
    if (result.starts.back() > 0xfffffff0ull) throw Error("photon map: more than 2^32 references; use fewer photons or a smaller radius");
    result.photons.resize(result.starts.back());
    std::vector<uint64_t> next(result.starts.begin(), result.starts.end() - 1);
    for (auto& chunk : chunks) {
        for (const Reference& r : chunk) result.photons[next[r.map]++] = r.photon;
        std::vector<Reference>().swap(chunk);
    }
    return result;
}

}  // namespace lw
