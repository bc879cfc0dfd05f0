#include "app/walk/collision_mesh.h"

#include <algorithm>
#include <cmath>

#include "scene/triangle.h"

namespace lw {
namespace {

std::vector<Box> triangle_boxes(const Scene& scene) {
    std::vector<Box> boxes;
    boxes.reserve(scene.triangles.size());
    for (const uvec3& t : scene.triangles) {
        const vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
        boxes.push_back({min(a, min(b, c)), max(a, max(b, c))});
    }
    return boxes;
}

}  // namespace

CollisionMesh::CollisionMesh(const Scene& scene, const RayCaster& caster)
    : scene_(scene), caster_(caster), triangles_(triangle_boxes(scene)) {}

bool CollisionMesh::is_free(vec3 from, vec3 to) const {
    const float distance = length(to - from);
    return !(distance > 0) || !caster_.nearest(from, (to - from) / distance, distance);
}

std::optional<float> CollisionMesh::floor_below(vec3 point) const {
    const std::optional<Hit> hit = caster_.nearest(point, vec3(0, -1, 0));
    return hit ? std::optional(point.y - hit->distance) : std::nullopt;
}

CollisionMesh::Contact CollisionMesh::max_contact(const Capsule& capsule) const {
    const int spheres = 1 + int(std::ceil(capsule.length / capsule.radius));
    const vec3 reach(capsule.radius);
    Contact deepest;
    triangles_.overlapping({capsule.low - reach, capsule.low + vec3(0, capsule.length, 0) + reach}, [&](uint triangle) {
        const uvec3 t = scene_.triangles[triangle];
        const vec3 &a = scene_.positions[t.x], &b = scene_.positions[t.y], &c = scene_.positions[t.z];
        for (int i = 0; i < spheres; ++i) {
            const float up = spheres > 1 ? capsule.length * float(i) / float(spheres - 1) : 0.0f;
            const vec3 centre = capsule.low + vec3(0, up, 0);
            const vec3 away = centre - closest_point_on_triangle(centre, a, b, c);
            const float depth = capsule.radius - length(away);
            if (depth > deepest.depth) deepest = {away, depth};
        }
    });
    return deepest;
}

float CollisionMesh::overlap(const Capsule& capsule) const { return max_contact(capsule).depth; }

vec3 CollisionMesh::push_out(const Capsule& capsule) const {
    vec3 move(0);
    for (int i = 0; i < 6; ++i) {
        const Contact contact = max_contact({capsule.low + move, capsule.length, capsule.radius});
        if (contact.depth <= 0) break;
        const vec3 level(contact.away.x, 0, contact.away.z);
        const float distance = length(level);
        if (distance < 1e-6f * capsule.radius) break;  // from below or above: nothing to slide along
        const float vertical = contact.away.y;         // so far out that the distance is the radius
        const float wanted = std::sqrt(std::max(capsule.radius * capsule.radius - vertical * vertical, 0.0f));
        move += level / distance * (std::max(wanted - distance, 0.0f) + 1e-3f * capsule.radius);
    }
    return move;
}

}  // namespace lw
