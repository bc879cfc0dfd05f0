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

constexpr float way_beyond = 1.1f;  // lifts that a ray goes on beyond a border: a wall may lean by 45 degrees

vec3 longer(vec3 way, float by) { return way * (1 + by / std::max(length(way), 1e-20f)); }

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
      cos_angle_(std::cos(glm::radians(input.partition.neighbour_angle_deg))) {}

PatchFinder::~PatchFinder() = default;

vec3 PatchFinder::normal_of(const Photon& photon) const {
    const vec3 product = triangle_product(in_.scene, photon.triangle);
    const float size = length(product) * (photon.side() ? -1.0f : 1.0f);
    return size != 0 ? product / size : vec3(0);  // zero never passes the angle test
}

bool PatchFinder::belongs(vec3 position, vec3 normal, uint patch) const {
    const PatchBoxes& boxes = boxes_[patch];
    const Floats at = floats(position), local = boxes.to_local(at);
    const Floats outside = outside_of(boxes.low, boxes.high, local);
    const float radius = in_.partition.radii[patch], radius2 = radius * radius;
    float distance2 = squared(outside);
    if (distance2 > radius2) return false;
    if (squared(outside_of(boxes.box_low, boxes.box_high, at)) > radius2) return false;
    const PatchShape& shape = in_.partition.shapes[patch];
    const float cosine = dot(shape.normal, normal);
    if (cosine < cos_angle_) return false;
    if (shape.triangles == 1 || !shape.outline.empty()) {
        const vec3 d = position - nearest_point(position, vector(local), shape);
        distance2 = dot(d, d);
    }
    const float height = outside[2] - 0.01f * radius;
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
    // A box that is turned against the cell of the patch reaches beyond it, and beyond a wall along its border.
    return clamp(shape.to_scene(nearest), shape.box_low, shape.box_high);
}

/// Whether no wall stands between a photon and a patch of the same plane: a ray a little above it, and a little
/// beyond the patch's border, meets nothing. At the corner of a piece the ray ends as far from both of its walls.
bool PatchFinder::is_in_sight(vec3 position, vec3 normal, Sight sight) const {
    const PatchShape& shape = in_.partition.shapes[sight.patch];
    if (shape.cos_spread < same_plane || dot(shape.normal, normal) < same_plane) return true;
    const float lift = lift_of(std::min(in_.partition.scales[sight.own], in_.partition.scales[sight.patch]));
    const float beyond = way_beyond * lift;
    vec3 end = nearest_point(position, shape.to_local(position), shape);
    if (!shape.outline.empty()) {
        const vec3 local = shape.to_local(end);
        end = shape.to_scene(vec3(inside_outline(shape.outline, vec2(local), beyond), local.z));
    }
    return is_clear(position, normal, longer(end - position, beyond), lift);
}

/// Whether a photon close to the border of its own piece sees the inside of it: a chord does not follow a round
/// wall everywhere.
bool PatchFinder::is_before_the_wall(vec3 position, vec3 normal, uint own) const {
    const PatchShape& shape = in_.partition.shapes[own];
    if (shape.outline.empty()) return true;
    const vec2 place(shape.to_local(position));
    const float scale = in_.partition.scales[own];
    const vec2 way = inside_outline(shape.outline, place, 5.0f * width_of_chords(scale)) - place;
    if (way == vec2(0)) return true;
    const float lift = lift_of(scale);
    return is_clear(position, normal, longer(shape.u_axis * way.x + shape.v_axis * way.y, way_beyond * lift), lift);
}

float PatchFinder::lift_of(float scale) const { return std::max(height_of_cuts(scale), 8 * in_.caster.epsilon()); }

/// Whether a ray along a plane, `lift` above it, meets nothing.
bool PatchFinder::is_clear(vec3 position, vec3 normal, vec3 way, float lift) const {
    way -= normal * dot(way, normal);
    const float distance = length(way);
    if (!(distance > 0)) return true;
    if (in_.caster.nearest(in_.caster.offset(position, normal), normal, lift)) return false;  // under a leaning wall
    return !in_.caster.nearest(position + normal * lift, way / distance, distance);
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
        if (belongs(p.position, normal, patch) && is_in_sight(p.position, normal, {own, patch}))
            found.push_back({patch, photon});
    return stays || found.size() == first;
}

}  // namespace lw
