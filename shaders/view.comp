// Turns pictures into what the window shows, 8-bit sRGB codes: exposed, in false colours, or A beside B. Another
// pipeline of it writes the values of a coarse grid of pixels for the CPU, for exposure and ranges.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "color.h"
#include "view.h"
#include "view_constants.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { ViewPush push; };
layout(set = 0, binding = binding_view_light) uniform textureBuffer light;
layout(set = 0, binding = binding_view_other) uniform textureBuffer other;
layout(set = 0, binding = binding_view_visibility) uniform utexture2D visibility;
layout(set = 0, binding = binding_view_screen, scalar) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = binding_view_readback, scalar) writeonly buffer Glances { ReadbackPixel readback_pixels[]; };

uint pixel_at(ivec2 at) {
    ivec2 p = clamp(at, ivec2(0), ivec2(push.picture) - 1);
    return uint(p.y) * push.picture.x + uint(p.x);
}

vec4 light_of(uint pixel, uint side) {
    return side == 0u ? texelFetch(light, int(pixel)) : texelFetch(other, int(pixel));
}

/// The light of picture A (side 0) or B (side 1) at `at`, in pixels of the picture, interpolated between the four
/// pixels around.
vec4 light_between(vec2 at, uint side) {
    vec2 corner = at - 0.5f;
    ivec2 base = ivec2(floor(corner));
    vec2 f = corner - floor(corner);
    vec4 rows[2];
    for (int y = 0; y < 2; ++y) {
        uint p = pixel_at(base + ivec2(0, y));
        uint q = pixel_at(base + ivec2(1, y));
        rows[y] = mix(light_of(p, side), light_of(q, side), f.x);
    }
    return mix(rows[0], rows[1], f.y) * push.scale_light;
}

vec4 light_at_screen(vec2 at, uint side) {
    if (is_scaled) return light_between(at * vec2(push.picture) / vec2(push.screen), side);
    uint p = pixel_at(ivec2(at));
    return light_of(p, side) * (uint(at.y) < push.fresh_rows ? push.scale_fresh : push.scale_light);
}

ivec2 nearest_pixel(vec2 at) { return is_scaled ? ivec2(at * vec2(push.picture) / vec2(push.screen)) : ivec2(at); }

/// The value that the view shows in false colours, in its unit.
float value_at(vec2 at, bool right_side) {
    if (is_inspection(shown_view)) {
        vec4 inspected = texelFetch(other, int(pixel_at(nearest_pixel(at))));
        if (shown_view == view_bandwidth) return 100.0f * inspected.x;
        if (shown_view == view_error) return 100.0f * inspected.z;
        return shown_view == view_photons ? inspected.w : inspected.y;
    }
    vec4 a = light_at_screen(at, right_side && !is_signed_view(shown_view) ? 1u : 0u);
    if (shown_view == view_luminance || shown_view == view_shaded) return luminance(a.xyz);
    if (shown_view == view_illuminance) return a.w;
    float change = light_at_screen(at, 1u).w - a.w;
    if (shown_view == view_difference) return change;
    return a.w > 1e-4f ? 100.0f * change / a.w : (change > 1e-4f ? 1e6f : 0.0f);
}

vec3 shaded(vec4 a) {
    if (any(isnan(a.xyz))) return vec3(1.0f, 0.0f, 1.0f);
    return encode_srgb(apply_curve(max(a.xyz, vec3(0.0f)) * exposure_scale(push.exposure_ev), shown_curve));
}

float depth_at(vec2 at) {
    ivec2 pixel = clamp(nearest_pixel(at), ivec2(0), ivec2(push.picture) - 1);
    return uintBitsToFloat(texelFetch(visibility, pixel, 0).w);
}

/// True where an isolux line passes between this pixel and the next ones of the same surface.
bool is_on_line(vec2 at, bool right_side) {
    bool logarithmic = push.logarithmic != 0u;
    float here =
        floor(place_in_range(value_at(at, right_side), push.low, push.high, logarithmic) * float(push.lines) + 0.001f);
    float depth = depth_at(at);
    for (int i = 0; i < 2; ++i) {
        vec2 next = at + (i == 0 ? vec2(1.0f, 0.0f) : vec2(0.0f, 1.0f));
        if (next.x >= float(push.screen.x) || next.y >= float(push.screen.y)) continue;
        if (abs(depth_at(next) - depth) > 0.03f * depth) continue;
        float there = floor(
            place_in_range(value_at(next, right_side), push.low, push.high, logarithmic) * float(push.lines) + 0.001f);
        if (there != here && max(here, there) >= 0.0f && min(here, there) <= float(push.lines)) return true;
    }
    return false;
}

vec3 color_at(vec2 at, bool right_side) {
    vec4 a = light_at_screen(at, right_side ? 1u : 0u);
    if (shown_view == view_shaded) return shaded(a);
    if (depth_at(at) <= 0.0f) return vec3(0.0f);
    float value = value_at(at, right_side);
    if (shown_view == view_photons) return value > 0.5f ? lamp_color(uint(value + 0.5f) - 1u) : 0.35f * shaded(a);
    if (isnan(value)) return vec3(1.0f, 0.0f, 1.0f);
    vec3 color = view_color(shown_view, value, push.low, push.high, push.logarithmic != 0u);
    return has_lines && is_on_line(at, right_side) ? vec3(0.02f) : color;
}

/// The pixel that stands for a cell of the readback; none beyond it or in a screen of fewer pixels.
uvec2 pixel_of_readback(uvec2 cell) {
    uvec2 cells = uvec2(readback_columns, readback_rows);
    uvec2 xy = (2u * cell + 1u) * push.screen / (2u * cells);
    return cell.x < cells.x && cell.y < cells.y && xy * cells / push.screen == cell ? xy : push.screen;
}

void write_readback(uvec2 cell, vec2 at, bool right_side) {
    ReadbackPixel g;
    vec4 shown = light_at_screen(at, right_side ? 1u : 0u);
    g.luminance = luminance(shown.xyz);
    g.illuminance = shown.w;
    g.value = value_at(at, right_side);
    g.seen = depth_at(at) > 0.0f ? 1.0f : 0.0f;
    readback_pixels[cell.y * readback_columns + cell.x] = g;
}

void main() {
    uvec2 xy = is_readback ? pixel_of_readback(gl_GlobalInvocationID.xy) : gl_GlobalInvocationID.xy;
    if (xy.x >= push.screen.x || xy.y >= push.screen.y) return;
    vec2 at = vec2(xy) + 0.5f;
    float edge = push.split * float(push.screen.x);
    bool right_side = has_split && at.x > edge;
    if (is_readback) {
        write_readback(gl_GlobalInvocationID.xy, at, right_side);
        return;
    }
    vec3 color = color_at(at, right_side);
    if (has_split && abs(at.x - edge) < 1.0f) color = vec3(1.0f);
    if (push.bgr != 0u) color = color.zyx;
    codes[xy.y * push.screen.x + xy.x] = packUnorm4x8(vec4(color, 1.0f));
}
