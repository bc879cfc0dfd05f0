// Writes which triangle a pixel sees, and where on it. Cut-out texels and glass let the view through.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "frame.h"
#include "surface.glsl"

layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uint triangle;
layout(location = 0) out uvec4 visible;  // triangle, barycentrics as float bits, 0

bool is_see_through() {
    uint flags = materials[objects[triangle_objects[triangle]].material].flags;
    bool cut_out = has_alpha && (flags & (material_alpha_mask | material_alpha_blend)) != 0u;
    if (!cut_out && !has_transmission) return false;
    Surface s = surface_at(triangle, barycentrics);
    if (has_transmission && s.transmission > 0.5f && s.metallic < 0.5f) return true;
    if (!cut_out) return false;
    float cutoff = materials[objects[triangle_objects[triangle]].material].alpha_cutoff;
    return s.alpha < ((flags & material_alpha_mask) != 0u ? cutoff : 0.5f);
}

void main() {
    if ((has_alpha || has_transmission) && is_see_through()) discard;
    visible = uvec4(triangle, floatBitsToUint(barycentrics.x), floatBitsToUint(barycentrics.y), 0u);
}
