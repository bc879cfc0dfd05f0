#include "maps/patch_finder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/outline.h"
#include "maps/wall_lines.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr float same_plane = 0.999f;     // least cosine between normals
constexpr float one_plane = 0.9999999f;  // the same of triangles that share a normal

float largest_of(const std::vector<float>& radii) {
    return radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
}

/// Three coordinates in a vector register. Where there is much furniture a photon is tested against ten patches, so the
/// tests must be fast.
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

}  // namespace

/// The boxes of a PatchShape, and its frame by columns.
struct PatchFinder::PatchBoxes {
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

PatchFinder::PatchFinder(const ReferenceInput& input)
    : in_(input),
      boxes_(input.partition.shapes.begin(), input.partition.shapes.end()),
      largest_(largest_of(input.partition.radii)),
      cos_angle_(std::cos(glm::radians(input.partition.neighbour_angle_deg))) {}

PatchFinder::~PatchFinder() = default;

vec3 PatchFinder::normal_of(const Photon& photon) const {
    const vec3 product = triangle_product(in_.scene, photon.triangle);
    const float size = length(product) * (photon.side() ? -1.0f : 1.0f);
    return size != 0 ? product / size : vec3(0);  // a zero normal never passes the angle test
}

bool PatchFinder::belongs(vec3 position, vec3 normal, uint patch) const {
    const PatchBoxes& boxes = boxes_[patch];
    const Floats at = floats(position), local = boxes.to_local(at);
    const Floats outside = outside_of(boxes.low, boxes.high, local);
    const float radius2 = in_.partition.radii[patch] * in_.partition.radii[patch];
    float distance2 = squared(outside);
    if (distance2 > radius2) return false;
    if (squared(outside_of(boxes.box_low, boxes.box_high, at)) > largest_ * largest_) return false;
    const PatchShape& shape = in_.partition.shapes[patch];
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
vec3 PatchFinder::nearest_point(vec3 position, vec3 local, const PatchShape& shape) const {
    if (shape.triangles == 1 && shape.outline.empty()) {
        const auto [a, b, c] = triangle_corners(in_.scene, shape.triangle);
        return closest_point_on_triangle(position, a, b, c);
    }
    vec3 nearest = clamp(local, shape.low, shape.high);
    if (!shape.outline.empty()) nearest = vec3(nearest_in_outline(shape.outline, vec2(local)), nearest.z);
    return shape.to_scene(nearest);
}

/// True when no wall stands between a photon and a patch in the same plane: a ray a little above the plane, to a little
/// beyond the patch's border, meets nothing.
bool PatchFinder::is_in_sight(vec3 position, vec3 normal, uint patch) const {
    const PatchShape& shape = in_.partition.shapes[patch];
    if (shape.cos_spread < same_plane || dot(shape.normal, normal) < same_plane) return true;
    vec3 way = nearest_point(position, shape.to_local(position), shape) - position;
    return is_clear(position, normal, way);
}

/// True when a photon close to the border of its own piece sees the inside of the piece. It may not, because a chord
/// follows a round wall only nearly.
bool PatchFinder::is_before_the_wall(vec3 position, vec3 normal, uint own) const {
    const PatchShape& shape = in_.partition.shapes[own];
    if (shape.outline.empty()) return true;
    const vec2 place(shape.to_local(position));
    const vec2 way = inside_outline(shape.outline, place, 5.0f * width_of_chords(largest_)) - place;
    return way == vec2(0) || is_clear(position, normal, shape.u_axis * way.x + shape.v_axis * way.y);
}

/// True when a ray a little above a plane, a little longer than the vector `way` along it, meets nothing.
bool PatchFinder::is_clear(vec3 position, vec3 normal, vec3 way) const {
    way -= normal * dot(way, normal);
    const float distance = length(way);
    const float lift = std::max(height_of_cuts(largest_), 8 * in_.caster.epsilon());
    if (!(distance > 0)) return true;
    if (in_.caster.nearest(in_.caster.offset(position, normal), normal, lift))
        return false;                  // the photon is under a leaning wall
    const float beyond = 1.1f * lift;  // a wall may lean by 45 degrees
    return !in_.caster.nearest(position + normal * lift, way / distance, distance + beyond);
}

bool PatchFinder::find(uint photon, uint own, std::vector<NeighbourReference>& found) const {
    const Photon& p = in_.photons[photon];
    const std::span<const uint> near = in_.partition.neighbours.near(own, p.position);
    if (near.empty()) return true;
    const size_t first = found.size();
    const vec3 normal =
        in_.partition.shapes[own].cos_spread > one_plane ? in_.partition.shapes[own].normal : normal_of(p);
    const bool stays = is_before_the_wall(p.position, normal, own);
    for (uint patch : near)
        if (belongs(p.position, normal, patch) && is_in_sight(p.position, normal, patch))
            found.push_back({patch, photon});
    return stays || found.size() == first;
}

}  // namespace lw
