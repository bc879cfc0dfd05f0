/// Clip coordinates of a point, computed relative to the camera for precision. Depth is reversed with the far plane at
/// infinity: near / distance.
vec4 project(Frame frame, vec3 position) {
    vec3 offset = position - frame.camera_position;
    vec3 view = vec3(dot(offset, frame.camera_right), dot(offset, frame.camera_up), dot(offset, frame.camera_back));
    vec2 plane = view.xy * frame.projection - view.z * frame.jitter;
    return vec4(plane.x, -plane.y, frame.near, -view.z);
}
