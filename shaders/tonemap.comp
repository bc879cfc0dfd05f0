// Turns radiance into 8-bit sRGB codes for a screen: exposure, tone curve, encoding. A pixel that is not a number
// becomes magenta.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "frame.h"
#include "tonemap.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { Screen screen; };
layout(set = 1, binding = binding_light) uniform textureBuffer light;
layout(set = 1, binding = binding_screen, scalar) writeonly buffer Codes { uint codes[]; };  // RGBA8, R in the low byte

void main() {
    uvec2 xy = gl_GlobalInvocationID.xy;
    if (xy.x >= screen.width || xy.y >= screen.height) return;
    uint pixel = xy.y * screen.width + xy.x;
    vec3 radiance = texelFetch(light, int(pixel)).xyz;
    if (any(isnan(radiance))) {
        codes[pixel] = 0xffff00ffu;
        return;
    }
    vec3 toned = tone_curve(max(radiance, vec3(0.0f)) * exposure_scale(screen.exposure_ev));
    codes[pixel] = packUnorm4x8(vec4(encode_srgb(toned), 1.0f));
}
