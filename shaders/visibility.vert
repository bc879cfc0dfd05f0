// Reads the corners of the listed triangles, cluster_triangles in each instance, and projects them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "cull.h"
#include "resident.glsl"
#include "project.glsl"

layout(push_constant, scalar) uniform Push { Frame frame; };
layout(set = 1, binding = binding_listed_texels) uniform utextureBuffer listed;
layout(location = 0) out vec2 barycentrics;
layout(location = 1) flat out uint triangle;

void main() {
    uint place = first_listed + uint(gl_InstanceIndex) * cluster_triangles + uint(gl_VertexIndex) / 3u;
    triangle = texelFetch(listed, int(place)).x;
    uint corner = uint(gl_VertexIndex) % 3u;
    barycentrics = vec2(corner == 1u ? 1.0f : 0.0f, corner == 2u ? 1.0f : 0.0f);
    gl_Position = vec4(2.0f, 2.0f, 0.0f, 1.0f);  // outside the view, for entries without a triangle
    if (triangle != no_triangle) gl_Position = project(frame, corner_position(triangle, corner));
}
