// Pulls the corners of a cluster's triangles, an instance each, and projects them, relative to the camera for precision.
// Depth is reversed with the far plane at infinity: near / distance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "frame.h"

layout(push_constant, scalar) uniform Push { Frame frame; };
layout(location = 0) out vec2 barycentrics;
layout(location = 1) flat out uint triangle;

void main() {
    triangle = min(uint(gl_InstanceIndex) * cluster_triangles + uint(gl_VertexIndex) / 3u, frame.triangle_limit - 1u);
    uint corner = uint(gl_VertexIndex) % 3u;
    barycentrics = vec2(corner == 1u ? 1.0f : 0.0f, corner == 2u ? 1.0f : 0.0f);
    vec3 offset = positions[triangles[triangle][corner]] - frame.camera_position;
    vec3 view = vec3(dot(offset, frame.camera_right), dot(offset, frame.camera_up), dot(offset, frame.camera_back));
    vec2 plane = view.xy * frame.projection - view.z * frame.jitter;
    gl_Position = vec4(plane.x, -plane.y, frame.near, -view.z);
}
