#include "maps/references.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "maps/cuts.h"
#include "maps/wall_lines.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr size_t max_tasks = 64;
constexpr size_t min_task = 8192;
constexpr float same_plane = 0.999f;     // least cosine between normals
constexpr float one_plane = 0.9999999f;  // the same of triangles that share a normal
constexpr uint moved_out = ~0u;          // in place of a photon that its own patch does not keep

/// A reference to a photon of another patch.
struct NeighbourReference {
    uint patch, photon;
};

/// The photons [begin, end) of an order, and what was found of them for each patch.
struct Task {
    size_t begin, end;
    std::vector<uint> counts;
    std::vector<NeighbourReference> foreign{};
};

float largest_of(const std::vector<float>& radii) {
    return radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
}

/// Three coordinates in a register: a photon meets ten patches where there is much furniture, and most are too far.
using Floats = float __attribute__((vector_size(16)));

Floats floats(vec3 v) { return Floats{v.x, v.y, v.z, 0}; }
vec3 vector(Floats v) { return {v[0], v[1], v[2]}; }

/// How far a point lies outside a box, along each axis.
Floats outside_of(Floats low, Floats high, Floats at) {
    const Floats below = low - at, above = at - high, more = below > above ? below : above;
    return more > 0 ? more : Floats{};
}

float squared(Floats v) {
    const Floats squares = v * v;
    return squares[0] + squares[1] + squares[2];
}

/// The boxes of a PatchShape, and its frame by columns.
struct PatchBoxes {
    explicit PatchBoxes(const PatchShape& s)
        : anchor(floats(s.anchor)),
          frame{Floats{s.u_axis.x, s.v_axis.x, s.normal.x}, Floats{s.u_axis.y, s.v_axis.y, s.normal.y},
                Floats{s.u_axis.z, s.v_axis.z, s.normal.z}},
          low(floats(s.low)),
          high(floats(s.high)),
          box_low(floats(s.box_low)),
          box_high(floats(s.box_high)) {}

    Floats to_local(Floats position) const {
        const Floats offset = position - anchor;
        return frame[0] * offset[0] + frame[1] * offset[1] + frame[2] * offset[2];
    }

    Floats anchor;
    std::array<Floats, 3> frame;
    Floats low, high, box_low, box_high;
};

/// Finds the maps of one photon after another.
class MapFinder {
  public:
    explicit MapFinder(const ReferenceInput& input)
        : in_(input),
          boxes_(input.shapes.begin(), input.shapes.end()),
          largest_(largest_of(input.radii)),
          cos_angle_(std::cos(glm::radians(input.neighbour_angle_deg))) {}

    /// Appends every other patch than its `own` that refers to a photon. Returns whether its own does.
    bool find(uint photon, uint own, std::vector<NeighbourReference>& found) const {
        const Photon& p = in_.photons[photon];
        const std::span<const uint> near = in_.neighbours.near(own, p.position);
        if (near.empty()) return true;
        const size_t first = found.size();
        const vec3 normal = in_.shapes[own].cos_spread > one_plane ? in_.shapes[own].normal : normal_of(p);
        const bool stays = is_before_the_wall(p.position, normal, own);
        for (uint patch : near)
            if (belongs(p.position, normal, patch) && is_in_sight(p.position, normal, patch))
                found.push_back({patch, photon});
        return stays || found.size() == first;
    }

    uint own_patch(uint photon) const {
        const Photon& p = in_.photons[photon];
        return in_.patches.at(2 * p.triangle + p.side(), p.position);
    }

  private:
    vec3 normal_of(const Photon& photon) const {
        const vec3 product = triangle_product(in_.scene, photon.triangle);
        const float size = length(product) * (photon.side() ? -1.0f : 1.0f);
        return size != 0 ? product / size : vec3(0);  // zero never passes the angle test
    }

    bool belongs(vec3 position, vec3 normal, uint patch) const {
        const PatchBoxes& boxes = boxes_[patch];
        const Floats at = floats(position), local = boxes.to_local(at);
        const Floats outside = outside_of(boxes.low, boxes.high, local);
        const float radius2 = in_.radii[patch] * in_.radii[patch];
        float distance2 = squared(outside);
        if (distance2 > radius2) return false;
        if (squared(outside_of(boxes.box_low, boxes.box_high, at)) > largest_ * largest_) return false;
        const PatchShape& shape = in_.shapes[patch];
        const float cosine = dot(shape.normal, normal);
        if (cosine < cos_angle_) return false;
        if (shape.triangles == 1 || !shape.outline.empty()) {
            const vec3 d = position - nearest_point(position, vector(local), shape);
            distance2 = dot(d, d);
        }
        const float height = outside[2] - 0.01f * largest_;
        const float sine2 = std::max(0.0f, 1 - cosine * cosine) * 1.2f + 1e-4f;
        return distance2 <= radius2 && (height <= 0 || height * height <= sine2 * distance2);
    }

    /// The point of a patch nearest to `position`, which is at `local` in its frame.
    vec3 nearest_point(vec3 position, vec3 local, const PatchShape& shape) const {
        if (shape.triangles == 1 && shape.outline.empty()) {
            const auto [a, b, c] = triangle_corners(in_.scene, shape.triangle);
            return closest_point_on_triangle(position, a, b, c);
        }
        vec3 nearest = clamp(local, shape.low, shape.high);
        if (!shape.outline.empty()) nearest = vec3(nearest_in_outline(shape.outline, vec2(local)), nearest.z);
        return shape.to_scene(nearest);
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
    std::vector<PatchBoxes> boxes_;
    float largest_, cos_angle_;
};

/// All photons in at most `max_tasks` pieces, with a count for each patch.
std::vector<Task> split(const ReferenceInput& input) {
    const size_t photons = input.photons.size(), size = std::max(min_task, photons / max_tasks + 1);
    std::vector<Task> tasks;
    for (size_t begin = 0; begin < photons; begin += size)
        tasks.push_back({begin, std::min(begin + size, photons), std::vector<uint>(input.patches.count, 0)});
    return tasks;
}

/// Turns the counts of the tasks into the places where each writes first, patch after patch, those of a patch from
/// begin(patch) on; end(patch, place) learns where they end.
template <class Begin, class End>
void place_counts(std::vector<Task>& tasks, size_t patches, const Begin& begin, const End& end) {
    for (size_t p = 0; p < patches; ++p) {
        uint64_t next = begin(p);
        for (Task& task : tasks) next += std::exchange(task.counts[p], uint(next));
        end(p, next);
    }
}

/// The photons in the order of their own patches: those of patch p are photons[starts[p]] .. photons[starts[p + 1] -
/// 1].
References sort_by_patch(const ReferenceInput& input, const MapFinder& finder) {
    References sorted{{0}, std::vector<uint>(input.photons.size())};
    std::vector<uint> own(input.photons.size());
    std::vector<Task> tasks = split(input);
    parallel_for(tasks.size(), [&](size_t t) {
        for (size_t i = tasks[t].begin; i < tasks[t].end; ++i) ++tasks[t].counts[own[i] = finder.own_patch(uint(i))];
    });
    place_counts(
        tasks, input.patches.count, [&](size_t p) { return sorted.starts[p]; },
        [&](size_t, uint64_t place) { sorted.starts.push_back(place); });
    parallel_for(tasks.size(), [&](size_t t) {
        for (size_t i = tasks[t].begin; i < tasks[t].end; ++i) sorted.photons[tasks[t].counts[own[i]]++] = uint(i);
    });
    return sorted;
}

/// What other patches refer to, in pieces; photons that move out of their own patch are struck from `sorted`.
std::vector<Task> find_foreign(const ReferenceInput& input, const MapFinder& finder, References& sorted) {
    constexpr size_t ahead = 16;  // photons on their way from memory
    std::vector<Task> tasks = split(input);
    Progress progress("references", input.photons.size());
    parallel_for(tasks.size(), [&](size_t t) {
        Task& task = tasks[t];
        const auto after = std::upper_bound(sorted.starts.begin(), sorted.starts.end(), task.begin);
        size_t own = size_t(after - sorted.starts.begin()) - 1;
        for (size_t i = task.begin; i < task.end; ++i) {
            while (i >= sorted.starts[own + 1]) ++own;
            if (i + ahead < task.end) prefetch(input.photons[sorted.photons[i + ahead]]);
            if (!finder.find(sorted.photons[i], uint(own), task.foreign)) sorted.photons[i] = moved_out;
        }
        for (const NeighbourReference& reference : task.foreign) ++task.counts[reference.patch];
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
    std::vector<NeighbourReference> found;
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) kept += finder.find(uint(i * step), finder.own_patch(uint(i * step)), found);
    return count ? double(kept + found.size()) / double(count) : 0;
}

References find_references(const ReferenceInput& input) {
    const MapFinder finder(input);
    References sorted = sort_by_patch(input, finder);
    std::vector<Task> tasks = find_foreign(input, finder, sorted);
    References result{{0}, {}};
    const auto is_kept = [](uint photon) { return photon != moved_out; };
    const auto own_end = [&](size_t p) {
        const auto first = sorted.photons.begin() + int64_t(sorted.starts[p]),
                   last = sorted.photons.begin() + int64_t(sorted.starts[p + 1]);
        return result.starts[p] + uint64_t(std::count_if(first, last, is_kept));
    };
    place_counts(tasks, input.patches.count, own_end, [&](size_t, uint64_t place) { result.starts.push_back(place); });
    if (result.starts.back() > 0xfffffff0ull)
        throw Error("photon map: more than 2^32 references; use fewer photons or a smaller radius");
    result.photons.resize(result.starts.back());
    parallel_for(input.patches.count, [&](size_t p) {
        std::copy_if(sorted.photons.begin() + int64_t(sorted.starts[p]),
                     sorted.photons.begin() + int64_t(sorted.starts[p + 1]),
                     result.photons.begin() + int64_t(result.starts[p]), is_kept);
    });
    parallel_for(tasks.size(), [&](size_t t) {
        for (const NeighbourReference& reference : tasks[t].foreign)
            result.photons[tasks[t].counts[reference.patch]++] = reference.photon;
        tasks[t] = {};
    });
    return result;
}

}  // namespace lw
