#include "app/walk/walker.h"

#include <algorithm>
#include <cmath>

namespace lw {
namespace {

constexpr float gravity = 9.81f;           // m/s2
constexpr float max_step_seconds = 0.25f;  // so that a long frame does not become a leap
constexpr float eye_settles_per_second = 9.0f;
constexpr float steepest_look = 1.55f;  // radians

vec3 ahead_of(const Walker& w) { return {-std::sin(w.yaw), 0, -std::cos(w.yaw)}; }
vec3 right_of(const Walker& w) { return {std::cos(w.yaw), 0, -std::sin(w.yaw)}; }

Walker turned(Walker w, vec2 turn) {
    w.yaw = std::remainder(w.yaw + turn.x, 2 * lw_pi);
    w.pitch = std::clamp(w.pitch + turn.y, -steepest_look, steepest_look);
    return w;
}

vec3 at_most_unit(vec3 v) {
    const float l = length(v);
    return l > 1 ? v / l : v;
}

/// The capsule of the trunk, which begins above the highest step.
Capsule trunk(vec3 feet, const Body& body) {
    const float low = body.step + body.radius, high = std::max(low, body.eye_height - 0.5f * body.radius);
    return {feet + vec3(0, low, 0), high - low, body.radius};
}

/// The highest floor under the feet that can be stood on, and whether there is any floor under their middle.
struct Ground {
    bool exists = false;
    float height = 0;  // m, of the stored positions
};

Ground ground_below(vec3 feet, const Body& body, const CollisionMesh& collision) {
    const vec3 above(0, body.step, 0);
    Ground ground;
    const float reach = 0.6f * body.radius;
    const vec3 places[] = {{0, 0, 0}, {reach, 0, 0}, {-reach, 0, 0}, {0, 0, reach}, {0, 0, -reach}};
    for (const vec3& place : places) {
        const bool middle = &place == &places[0];
        if (!middle && !collision.is_free(feet + above, feet + above + place)) continue;
        const std::optional<float> floor = collision.floor_below(feet + above + place);
        if (middle && !floor) return ground;
        if (!floor) continue;
        ground.height = middle ? *floor : std::max(ground.height, *floor);
        ground.exists = true;
    }
    return ground;
}

/// True when no surface crosses the way of the shins, the chest or the eyes.
bool passes(vec3 from_feet, vec3 to_feet, const Body& body, const CollisionMesh& collision) {
    for (float height : {body.step * 1.02f, 0.5f * (body.step + body.eye_height), body.eye_height})
        if (!collision.is_free(from_feet + vec3(0, height, 0), to_feet + vec3(0, height, 0))) return false;
    return true;
}

/// The feet after one short move; unchanged when the way is blocked.
vec3 moved(vec3 feet, vec3 move, const Body& body, const CollisionMesh& collision) {
    const float overlap_before = collision.overlap(trunk(feet, body));
    vec3 to = feet + move;
    const Ground ground = ground_below(to, body, collision);
    if (!ground.exists) return feet;
    const bool stands = ground.height >= feet.y - body.step;
    if (stands) to.y = ground.height;
    to += collision.push_out(trunk(to, body));
    if (collision.overlap(trunk(to, body)) > std::max(overlap_before, 0.05f * body.radius)) return feet;
    const vec3 level(to.x, feet.y, to.z);
    if (!passes(feet, level, body, collision)) return feet;
    const Ground there = ground_below(to, body, collision);
    if (!there.exists || there.height > to.y + body.step) return feet;
    if (to.y > feet.y && !collision.is_free(level + vec3(0, body.eye_height, 0), to + vec3(0, body.eye_height, 0)))
        return feet;
    return to;
}

/// Puts the walker on the floor, or lets it fall towards it.
Walker fallen(Walker w, float seconds, const Body& body, const CollisionMesh& collision) {
    const vec3 feet = w.eye - vec3(0, w.height, 0);
    const Ground ground = ground_below(feet, body, collision);
    if (!ground.exists) return w;
    const float drop = feet.y - ground.height;
    if (drop <= body.step) {
        w.height += drop;  // the eye stays where it is and then follows
        w.fall_speed = 0;
        return w;
    }
    w.fall_speed += gravity * seconds;
    w.eye.y -= std::min(w.fall_speed * seconds, drop);
    return w;
}

/// Moves the eye smoothly to its height over the floor.
Walker settled(Walker w, float seconds, const Body& body, const CollisionMesh& collision) {
    const float change = (body.eye_height - w.height) * (1 - std::exp(-seconds * eye_settles_per_second));
    if (!collision.is_free(w.eye, w.eye + vec3(0, change + std::copysign(0.3f * body.radius, change), 0))) return w;
    w.height += change;
    w.eye.y += change;
    w.settling = std::abs(body.eye_height - w.height) > 1e-3f;
    return w;
}

Walker walked(Walker w, vec3 way, const Body& body, const CollisionMesh& collision) {
    const int parts = 1 + int(length(way) / (0.45f * body.radius));
    for (int i = 0; i < parts; ++i) {
        const vec3 feet = w.eye - vec3(0, w.height, 0), part = way / float(parts);
        vec3 to = moved(feet, part, body, collision);
        if (to == feet) to = moved(feet, vec3(part.x, 0, 0), body, collision);
        if (to == feet) to = moved(feet, vec3(0, 0, part.z), body, collision);
        if (to == feet) break;
        w.eye += vec3(to.x - feet.x, 0, to.z - feet.z);
        w.height -= to.y - feet.y;
    }
    return w;
}

}  // namespace

Body body_for(const Scene& scene) {
    const float storey = scene.bounds[1].y - scene.bounds[0].y, size = scene.size();
    Body body;
    const float scale = std::min(1.0f, storey > 0 ? storey / 2.0f : 1.0f);
    body.eye_height *= scale, body.radius *= scale, body.step *= scale;
    body.speed = std::clamp(0.11f * size, 0.0f, 4.0f);
    return body;
}

Walker walk(const Walker& before, const WalkInput& input, float seconds, const Body& body,
            const CollisionMesh& collision) {
    const float dt = std::clamp(seconds, 0.0f, max_step_seconds);
    Walker w = turned(before, input.turn);
    const float speed = body.speed * (input.fast ? body.shift_factor : 1.0f);
    if (w.flying) {
        const vec3 ahead = ahead_of(w) * std::cos(w.pitch) + vec3(0, std::sin(w.pitch), 0);
        w.eye += at_most_unit(right_of(w) * input.move.x + vec3(0, input.move.y, 0) + ahead * input.move.z) *
                 (1.5f * speed * dt);
        return w;
    }
    const vec3 way = at_most_unit(right_of(w) * input.move.x + ahead_of(w) * input.move.z) * (speed * dt);
    const bool moves = length(way) > 0;
    if (moves) w = walked(w, way, body, collision);
    if (moves || w.fall_speed > 0) {
        w = fallen(w, dt, body, collision);
        w.settling = true;
    }
    return w.settling ? settled(w, dt, body, collision) : w;
}

Walker walker_at(const Camera& camera, const Body& body, const CollisionMesh& collision) {
    Walker w;
    const vec3 ahead = -camera.rotation[2];
    w.eye = camera.position;
    w.yaw = std::atan2(-ahead.x, -ahead.z);
    w.pitch = std::clamp(std::asin(std::clamp(ahead.y, -1.0f, 1.0f)), -steepest_look, steepest_look);
    return land(w, body, collision);
}

Walker land(Walker w, const Body& body, const CollisionMesh& collision) {
    const std::optional<float> floor = collision.floor_below(w.eye);
    w.fall_speed = 0;
    w.settling = false;
    w.flying = !floor;
    w.height = body.eye_height;
    if (floor && w.eye.y - *floor < 1.6f * body.eye_height) w.height = w.eye.y - *floor;
    if (!w.flying && w.eye.y - w.height - *floor > body.step) w.fall_speed = 1e-3f;
    return w;
}

Camera camera_of(const Walker& w, float yfov, float near) {
    Camera camera;
    camera.name = "walker";
    camera.position = w.eye;
    const vec3 right = right_of(w), level = ahead_of(w);
    const vec3 ahead = level * std::cos(w.pitch) + vec3(0, std::sin(w.pitch), 0);
    camera.rotation = mat3(right, cross(right, ahead), -ahead);
    camera.yfov = yfov;
    camera.near = near;
    return camera;
}

}  // namespace lw
