// Writes the triangle that a pixel shows and the point on it. Holes of alpha masks let the view through, and so do
// glass and blends when no rays follow what is behind them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "resident.glsl"
#include "surface.glsl"

layout(push_constant, scalar) uniform Push { Frame frame; };
layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uint triangle;
layout(location = 0) out uvec4 visible;  // triangle, barycentrics and depth (m along -Z) as float bits

void main() {
    if (has_alpha && follows_through && is_hole(triangle, barycentrics)) discard;
    if ((has_alpha || has_transmission) && !follows_through && is_see_through(triangle, barycentrics)) discard;
    visible = uvec4(triangle, floatBitsToUint(barycentrics.x), floatBitsToUint(barycentrics.y),
                    floatBitsToUint(frame.near / gl_FragCoord.z));
}
