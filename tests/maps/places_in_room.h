// A furnished room with its patches, photons all over it, and by brute force whether one belongs to a patch: the rule
// of PatchFinder, in double precision.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "benchmark/rooms.h"
#include "maps/references.h"
#include "scene/triangle.h"

namespace lw::test {

struct RoomPatches {
    Scene scene = make_room({10'000, 2});
    Partition partition = partition_surfaces(scene, RayCaster(scene), {.radius = 0.25f});
};

inline const RoomPatches& furnished_room() {
    static const RoomPatches room;
    return room;
}

/// Photons on both sides of triangles, as many on each.
inline std::vector<Photon> places_in(const RoomPatches& room, size_t count) {
    std::vector<Photon> photons;
    for (size_t i = 0; i < count; ++i) {
        Rng rng(7, 1, i);
        const auto t = uint(rng.next() * float(room.scene.triangles.size()));
        const uvec3 c = room.scene.triangles[i % 3 == 0 ? t % 100 : t];  // the first are the large ones
        const float root = std::sqrt(rng.next()), part = rng.next();
        const vec3 position = room.scene.positions[c.x] * (1 - root) + room.scene.positions[c.y] * (root * (1 - part)) +
                              room.scene.positions[c.z] * (root * part);
        photons.push_back({position, vec3(1), vec3(0, 1, 0), i % 3 == 0 ? t % 100 : t,
                           pack_origin(0, path_direct, rng.next() < 0.5f)});
    }
    return photons;
}

enum class Belonging { no, close, sure };

/// Whether a photon belongs to a patch that is not its own; `close` where rounding, or how much more height than the
/// angle explains is allowed, decides. Walls that stand between are not looked at.
inline Belonging belonging_of(const RoomPatches& room, const Photon& photon, uint patch) {
    const PatchShape& shape = room.partition.shapes[patch];
    const uvec3 c = room.scene.triangles[photon.triangle];
    const glm::dvec3 a(room.scene.positions[c.x]), b(room.scene.positions[c.y]), d(room.scene.positions[c.z]);
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, d - a)) * (photon.side() ? -1.0 : 1.0);
    const double cosine = glm::dot(normal, glm::normalize(glm::dvec3(shape.normal)));
    const glm::dvec3 p(photon.position), offset = p - glm::dvec3(shape.anchor);
    const glm::dvec3 local(glm::dot(offset, glm::dvec3(shape.u_axis)), glm::dot(offset, glm::dvec3(shape.v_axis)),
                           glm::dot(offset, glm::dvec3(shape.normal)));
    const auto outside = [](glm::dvec3 low, glm::dvec3 high, glm::dvec3 at) {
        return glm::max(glm::max(low - at, at - high), glm::dvec3(0));
    };
    const glm::dvec3 beyond = outside(shape.low, shape.high, local);
    double distance = glm::length(beyond);
    if (!shape.outline.empty()) return Belonging::close;  // pieces of cut patches have tests of their own
    if (shape.triangles == 1) {
        const uvec3 t = room.scene.triangles[shape.triangle];
        const vec3 nearest = closest_point_on_triangle(photon.position, room.scene.positions[t.x],
                                                       room.scene.positions[t.y], room.scene.positions[t.z]);
        distance = glm::length(p - glm::dvec3(nearest));
    }
    const double to_bounds = glm::length(outside(shape.box_low, shape.box_high, p));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), height = beyond.z;
    const double cos_angle = std::cos(glm::radians(double(room.partition.neighbour_angle_deg))), margin = 1e-4;
    if (distance > double(room.partition.radii[patch]) + margin ||
        to_bounds > double(room.partition.radii[patch]) + margin || cosine < cos_angle - margin ||
        height > 0.01 * double(room.partition.radii[patch]) + (1.1 * sine + 0.011) * distance + margin)
        return Belonging::no;
    const bool is_near = distance < double(room.partition.radii[patch]) - margin &&
                         to_bounds < double(room.partition.radii[patch]) - margin;
    return is_near && cosine > cos_angle + margin && height <= sine * distance ? Belonging::sure : Belonging::close;
}

}  // namespace lw::test
