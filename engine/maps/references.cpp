#include "maps/references.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "maps/cuts.h"
#include "maps/wall_lines.h"

namespace lw {
namespace {

constexpr size_t most_tasks = 64;
constexpr float same_plane = 0.999f;        // least cosine between normals
constexpr uint first_of_photon = 1u << 31;  // marks the map of the photon's own side

/// The maps of the photons [begin, end) one after another, and how many references each map has among them.
struct Task {
    size_t begin, end;
    std::vector<uint> maps, counts;
};

float largest_of(const std::vector<float>& radii) {
    return radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
}

/// Finds the maps of one photon after another.
class MapFinder {
  public:
    explicit MapFinder(const ReferenceInput& input)
        : in_(input),
          largest_(largest_of(input.radii)),
          cos_angle_(std::cos(glm::radians(input.neighbour_angle_deg))) {}

    /// Appends every map that refers to the photon, its own first and marked.
    void find(const Photon& photon, std::vector<uint>& found) const {
        const uint own = in_.patches.at(2 * photon.triangle + photon.side(), photon.position);
        const std::span<const uint> near = in_.neighbours.near(own, photon.position);
        if (near.empty()) return found.push_back(own | first_of_photon);
        const size_t first = found.size();
        const vec3 normal = normal_of(photon);
        const bool stays = is_before_the_wall(photon.position, normal, own);
        if (stays) found.push_back(own | first_of_photon);
        for (uint patch : near)
            if (belongs(photon.position, normal, patch) && is_in_sight(photon.position, normal, patch))
                found.push_back(patch);
        if (stays) return;
        if (found.size() == first) found.push_back(own);
        found[first] |= first_of_photon;
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
        const float radius2 = in_.radii[patch] * in_.radii[patch];
        const vec3 local = shape.to_local(position);
        const vec3 outside = max(max(shape.low - local, local - shape.high), vec3(0));
        float distance2 = dot(outside, outside);
        if (distance2 > radius2) return false;
        const vec3 beside = max(max(shape.box_low - position, position - shape.box_high), vec3(0));
        if (dot(beside, beside) > largest_ * largest_) return false;
        const float cosine = dot(shape.normal, normal);
        if (cosine < cos_angle_) return false;
        if (shape.triangles == 1 || !shape.outline.empty()) {
            const vec3 d = position - nearest_point(position, local, shape);
            distance2 = dot(d, d);
        }
        const float height = outside.z - 0.01f * largest_;
        const float sine2 = std::max(0.0f, 1 - cosine * cosine) * 1.2f + 1e-4f;
        return distance2 <= radius2 && (height <= 0 || height * height <= sine2 * distance2);
    }

    /// The point of a patch nearest to `position`, which is at `local` in its frame.
    vec3 nearest_point(vec3 position, vec3 local, const PatchShape& shape) const {
        if (shape.triangles == 1 && shape.outline.empty()) {
            const uvec3 c = in_.scene.triangles[shape.triangle];
            return closest_point_on_triangle(position, in_.scene.positions[c.x], in_.scene.positions[c.y],
                                             in_.scene.positions[c.z]);
        }
        vec3 nearest = clamp(local, shape.low, shape.high);
        if (!shape.outline.empty()) nearest = vec3(nearest_in_outline(shape.outline, vec2(local)), nearest.z);
        return shape.anchor + shape.u_axis * nearest.x + shape.v_axis * nearest.y + shape.normal * nearest.z;
    }

    /// Whether no wall stands between a photon and a patch of the same plane: a ray a little above it, and a little
    /// beyond the patch's border, meets nothing.
    bool is_in_sight(vec3 position, vec3 normal, uint patch) const {
        const PatchShape& shape = in_.shapes[patch];
        if (shape.cos_spread < same_plane || dot(shape.normal, normal) < same_plane) return true;
        vec3 way = nearest_point(position, shape.to_local(position), shape) - position;
        return is_clear(position, normal, way);
    }

    /// Whether a photon close to the border of its own piece sees the inside of it: a chord does not follow a round
    /// wall everywhere.
    bool is_before_the_wall(vec3 position, vec3 normal, uint own) const {
        const PatchShape& shape = in_.shapes[own];
        if (shape.outline.empty()) return true;
        const vec2 place(shape.to_local(position));
        const vec2 way = inside_outline(shape.outline, place, 5.0f * width_of_chords(largest_)) - place;
        return way == vec2(0) || is_clear(position, normal, shape.u_axis * way.x + shape.v_axis * way.y);
    }

    /// Whether a ray a little above a plane, and a little longer than the way along it, meets nothing.
    bool is_clear(vec3 position, vec3 normal, vec3 way) const {
        way -= normal * dot(way, normal);
        const float distance = length(way);
        const float lift = std::max(height_of_cuts(largest_), 8 * in_.caster.epsilon());
        if (!(distance > 0)) return true;
        if (in_.caster.nearest(in_.caster.offset(position, normal), normal, lift))
            return false;                  // under a leaning wall
        const float beyond = 1.1f * lift;  // a wall may lean by 45 degrees
        return !in_.caster.nearest(position + normal * lift, way / distance, distance + beyond);
    }

    const ReferenceInput& in_;
    float largest_, cos_angle_;
};

/// The references of all photons, in at most `most_tasks` pieces.
std::vector<Task> find_maps(const ReferenceInput& input) {
    const MapFinder finder(input);
    const size_t photons = input.photons.size(), size = std::max<size_t>(8192, photons / most_tasks + 1);
    std::vector<Task> tasks;
    for (size_t begin = 0; begin < photons; begin += size)
        tasks.push_back({begin, std::min(begin + size, photons), {}, {}});
    Progress progress("references", photons);
    parallel_for(tasks.size(), [&](size_t t) {
        Task& task = tasks[t];
        task.maps.reserve((task.end - task.begin) * 2);
        for (size_t i = task.begin; i < task.end; ++i) finder.find(input.photons[i], task.maps);
        task.counts.assign(input.patches.count, 0);
        for (uint map : task.maps) ++task.counts[map & ~first_of_photon];
        progress.step(task.end - task.begin);
    });
    return tasks;
}

}  // namespace

std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor, float overhang) {
    std::vector<float> radii;
    for (const PatchShape& shape : shapes) {
        const vec3 size = shape.high - shape.low;
        const float perimeter = 2 * (size.x + size.y), area = size.x * size.y;
        const float bound = (-perimeter + std::sqrt(perimeter * perimeter + 4 * overhang * lw_pi * area)) / (2 * lw_pi);
        radii.push_back(clamp(bound, std::min(floor, largest), largest));
    }
    return radii;
}

double sample_references(const ReferenceInput& input, size_t samples) {
    const MapFinder finder(input);
    const std::vector<Photon>& photons = input.photons;
    const size_t step = std::max<size_t>(1, photons.size() / samples), count = photons.size() / step;
    std::vector<uint> found;
    for (size_t i = 0; i < count; ++i) finder.find(photons[i * step], found);
    return count ? double(found.size()) / double(count) : 0;
}

References find_references(const ReferenceInput& input) {
    std::vector<Task> tasks = find_maps(input);
    References result;
    result.starts.assign(1, 0);
    for (size_t m = 0; m < input.patches.count; ++m) {
        uint64_t next = result.starts[m];
        for (Task& task : tasks) {
            const uint count = task.counts[m];
            task.counts[m] = uint(next);  // where the task writes its next reference
            next += count;
        }
        result.starts.push_back(next);
    }
    if (result.starts.back() > 0xfffffff0ull)
        throw Error("photon map: more than 2^32 references; use fewer photons or a smaller radius");
    result.photons.resize(result.starts.back());
    parallel_for(tasks.size(), [&](size_t t) {
        Task& task = tasks[t];
        size_t photon = task.begin - 1;
        for (uint map : task.maps) {
            photon += map / first_of_photon;
            result.photons[task.counts[map & ~first_of_photon]++] = uint(photon);
        }
        task = {};
    });
    return result;
}

}  // namespace lw
