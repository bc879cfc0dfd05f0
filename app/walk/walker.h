// A person in the building: state, input and seconds in, the next state out; no window, no clock. Metres, radians, Y
// up. Walking slides along walls, climbs steps, never passes a surface and never leaves the floor; flying passes
// everything.
#pragma once
#include "app/walk/collision_mesh.h"

namespace lw {

/// Measures of the walker in m, and speeds.
struct Body {
    float eye_height = 1.65f;
    float radius = 0.22f;
    float step = 0.35f;         // highest step that is climbed
    float speed = 1.5f;         // m/s
    float shift_factor = 2.5f;  // with Shift
};

/// The body for a scene: a person in a building, a smaller body in a scene lower than a storey.
Body body_for(const Scene& scene);

struct Walker {
    vec3 eye{0};
    float yaw = 0;    // 0 looks along -Z, positive to the left
    float pitch = 0;  // positive upwards
    bool flying = false;
    float height = 1.65f;   // of the eye above the feet; follows the floor smoothly
    float fall_speed = 0;   // m/s, downwards
    bool settling = false;  // `height` still moves towards that of the body
};

struct WalkInput {
    vec3 move{0};  // right, up (flying), forward: each -1 to 1
    vec2 turn{0};  // radians to the left, upwards
    bool fast = false;
};

/// The state after `seconds`, of which at most 0.25 are simulated.
Walker walk(const Walker& before, const WalkInput& input, float seconds, const Body& body,
            const CollisionMesh& collision);

/// A walker with the view of the camera; flying when there is no floor within reach of the feet.
Walker walker_at(const Camera& camera, const Body& body, const CollisionMesh& collision);

/// The walker set on the floor below; still flying when there is none.
Walker land(Walker walker, const Body& body, const CollisionMesh& collision);

/// The camera at the walker's eye.
Camera camera_of(const Walker& walker, float yfov, float near);

}  // namespace lw
