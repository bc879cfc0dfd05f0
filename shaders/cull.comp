// Finds the triangles that may cover the centre of a pixel. Doubtful ones are kept, so that the picture is that of all
// triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "cull.h"
#include "resident.glsl"
#include "project.glsl"

layout(local_size_x = cull_group) in;
layout(push_constant, scalar) uniform Push { Frame frame; };
layout(set = 1, binding = binding_clusters) uniform utextureBuffer clusters;
layout(set = 1, binding = binding_survivors, scalar) writeonly buffer Blocks { Survivors blocks[]; };

Cluster cluster_at(uint i) {
    uvec4 low = texelFetch(clusters, int(cluster_texels * i)), high = texelFetch(clusters, int(cluster_texels * i) + 1);
    return Cluster(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}

bool is_beyond(vec3 centre, vec3 half_size, vec3 normal, float offset) {
    return dot(normal, centre) + dot(abs(normal), half_size) < offset;
}

/// True when the whole box is outside one plane of the view: behind the near plane, or beyond a side.
bool is_outside(Cluster box) {
    vec3 centre = 0.5f * (box.low + box.high) - frame.camera_position, half_size = 0.5f * (box.high - box.low);
    vec3 ahead = -frame.camera_back;
    vec2 slope = (vec2(1.0f) + abs(frame.jitter)) / frame.projection;
    return is_beyond(centre, half_size, ahead, frame.near) ||
           is_beyond(centre, half_size, ahead * slope.x - frame.camera_right, 0.0f) ||
           is_beyond(centre, half_size, ahead * slope.x + frame.camera_right, 0.0f) ||
           is_beyond(centre, half_size, ahead * slope.y - frame.camera_up, 0.0f) ||
           is_beyond(centre, half_size, ahead * slope.y + frame.camera_up, 0.0f);
}

/// Bounds (least, most) of twice the signed area of the triangles that p and q form with points within `reach` of the
/// origin, where the rasterizer and rounding may have moved p and q by pixel_margin.
vec2 area_with(vec2 p, vec2 q, vec2 reach) {
    vec2 side = abs(q - p) + 2.0f * pixel_margin, far = abs(p) + abs(q) + 2.0f * pixel_margin;
    float slack = pixel_margin * (far.x + far.y) + side.x * reach.y + side.y * reach.x;
    return p.x * q.y - p.y * q.x + vec2(-slack, slack);
}

/// Corners in pixels, in front of the near plane. False when there is no pixel centre in the triangle's box, or one
/// side has all of those in the box beyond it. A side that ends far outside the picture leaves its triangle a box as
/// large.
bool may_cover_centre(vec2 p, vec2 q, vec2 r) {
    vec2 size = vec2(frame.width, frame.height), low = min(p, min(q, r)), high = max(p, max(q, r));
    if (any(lessThan(high, vec2(0.0f))) || any(greaterThan(low, size))) return false;
    vec2 first = ceil(low - pixel_margin - 0.5f) + 0.5f, last = floor(high + pixel_margin - 0.5f) + 0.5f;
    if (any(lessThan(last, first))) return false;
    vec2 middle = 0.5f * (first + last), reach = 0.5f * (last - first);
    p -= middle, q -= middle, r -= middle;
    vec2 a = area_with(p, q, reach), b = area_with(q, r, reach), c = area_with(r, p, reach);
    return min(a.y, min(b.y, c.y)) >= 0.0f || max(a.x, max(b.x, c.x)) <= 0.0f;
}

bool may_be_seen(uint triangle) {
    vec4 a = project(frame, corner_position(triangle, 0u));
    vec4 b = project(frame, corner_position(triangle, 1u));
    vec4 c = project(frame, corner_position(triangle, 2u));
    if (max(a.w, max(b.w, c.w)) < 0.9f * frame.near) return false;
    if (min(a.w, min(b.w, c.w)) < frame.near) return true;
    vec2 half_size = 0.5f * vec2(frame.width, frame.height);
    vec2 p = a.xy / a.w * half_size + half_size;
    vec2 q = b.xy / b.w * half_size + half_size;
    vec2 r = c.xy / c.w * half_size + half_size;
    return may_cover_centre(p, q, r);
}

void main() {
    uint block = gl_GlobalInvocationID.x;
    if (block >= uint(blocks.length())) return;
    Cluster cluster = cluster_at(block / blocks_per_cluster);
    uint first = cluster.first + block % blocks_per_cluster * block_triangles;
    uint end = is_outside(cluster) ? first : min(first + block_triangles, cluster.end);
    uint mask = 0u;
    for (uint triangle = first; triangle < end; ++triangle)
        if (may_be_seen(triangle)) mask |= 1u << (triangle - first);
    blocks[block].mask = mask;
}
