// A person in the building: state, input and seconds in, the next state out; no window, no clock. Metres, radians, Y
// up. Walking slides along walls, climbs steps, never passes a surface and never leaves the floor; flying passes
// everything.
#pragma once
#include "app/walk/collision_mesh.h"

namespace lw {

/// Measures of the walker, m.
struct Body {
    float eye_height = 1.65f;
    float radius = 0.22f;
    float step = 0.35f;         // highest step that is climbed
    float speed = 1.5f;         // m/s
    float shift_factor = 2.5f;  // with Shift
};

/// The body and its speed for a scene: a person in a building, smaller in something lower than a storey.
Body body_for(const Scene& scene);

struct Walker {
    vec3 eye{0};
    float yaw = 0;    // 0 looks along -Z, positive to the left
    float pitch = 0;  // positive upwards
    bool flying = false;
    float height = 1.65f;   // of the eye above the feet; follows the floor smoothly
    float fall_speed = 0;   // m/s, downwards
    bool settling = false;  // the height is on its way to that of the body
};

struct WalkInput {
    vec3 move{0};  // right, up (flying), forward: each -1 to 1
    vec2 turn{0};  // radians to the left, upwards
    bool fast = false;
};

/// The walker after `seconds` (at most a quarter of one is simulated).
Walker walk(const Walker& before, const WalkInput& input, float seconds, const Body& body,
            const CollisionMesh& collision);

/// A walker who sees what the camera sees; flying when no floor is within reach of the feet.
Walker walker_at(const Camera& camera, const Body& body, const CollisionMesh& collision);

/// The same place, on the feet when there is a floor below, else flying on.
Walker land(Walker walker, const Body& body, const CollisionMesh& collision);

/// What the walker sees.
Camera camera_of(const Walker& walker, float yfov, float near);

}  // namespace lw
