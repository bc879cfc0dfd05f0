// The scene and its map as the shaders find them in descriptor set 0 (frame.h, gather/resident): specialization
// constants, arrays, and the functions by which the texts shared with C++ read them.
#include "frame.h"
#include "frame_constants.h"

layout(set = 0, binding = binding_corners) uniform textureBuffer corners;
layout(set = 0, binding = binding_triangles) uniform utextureBuffer triangles;
layout(set = 0, binding = binding_uv1) uniform textureBuffer uv1;
layout(set = 0, binding = binding_colors) uniform textureBuffer colors;
layout(set = 0, binding = binding_tangents) uniform textureBuffer tangents;
layout(set = 0, binding = binding_texels) uniform textureBuffer texels;
layout(set = 0, binding = binding_materials) uniform utextureBuffer material_records;
layout(set = 0, binding = binding_textures) uniform utextureBuffer texture_records;

vec3 corner_position(uint triangle, uint c) { return texelFetch(corners, int(6u * triangle + 2u * c)).xyz; }
vec3 corner_normal(uint triangle, uint c) { return texelFetch(corners, int(6u * triangle + 2u * c + 1u)).xyz; }
vec2 corner_uv0(uint triangle, uint c) {
    int first = int(6u * triangle + 2u * c);
    return vec2(texelFetch(corners, first).w, texelFetch(corners, first + 1).w);
}
vec2 corner_uv1(uint triangle, uint c) { return texelFetch(uv1, int(3u * triangle + c)).xy; }
vec4 corner_color(uint triangle, uint c) { return texelFetch(colors, int(3u * triangle + c)); }
vec4 corner_tangent(uint triangle, uint c) { return texelFetch(tangents, int(3u * triangle + c)); }
uint texel_word(uint i) { return packUnorm4x8(texelFetch(texels, int(i))); }
vec4 texel_at(uint i) { return texelFetch(texels, int(i)); }

Texture texture_at(int i) {
    uvec4 first = texelFetch(texture_records, int(texture_texels) * i);
    uvec4 second = texelFetch(texture_records, int(texture_texels) * i + 1);
    return Texture(first.x, first.y, first.z, first.w, second.x, second.y, second.z);
}

/// Slot `i` of a material: two texels' words, from the second word of the first on.
TextureSlot texture_slot(int first, int i) {
    uvec4 a = texelFetch(material_records, first + 5 + 2 * i);
    uvec4 b = texelFetch(material_records, first + 6 + 2 * i);
    uvec4 c = texelFetch(material_records, first + 7 + 2 * i);
    return TextureSlot(int(a.y), a.z, uintBitsToFloat(uvec3(a.w, b.xy)), uintBitsToFloat(uvec3(b.zw, c.x)));
}

Material material_of(uint triangle) {
    int first = int(material_texels * texelFetch(triangles, int(triangle)).z);
    uvec4 t[6];
    for (int k = 0; k < 6; ++k) t[k] = texelFetch(material_records, first + k);
    Material m;
    m.base_color = uintBitsToFloat(t[0].xyz);
    m.alpha = uintBitsToFloat(t[0].w);
    m.emissive = uintBitsToFloat(t[1].xyz);
    m.metallic = uintBitsToFloat(t[1].w);
    m.specular_color = uintBitsToFloat(t[2].xyz);
    m.roughness = uintBitsToFloat(t[2].w);
    m.specular = uintBitsToFloat(t[3].x);
    m.ior = uintBitsToFloat(t[3].y);
    m.transmission = uintBitsToFloat(t[3].z);
    m.alpha_cutoff = uintBitsToFloat(t[3].w);
    m.normal_scale = uintBitsToFloat(t[4].x);
    m.flags = t[4].y;
    m.absorption = uintBitsToFloat(uvec3(t[4].zw, t[5].x));
    if (!has_textures) return m;
    m.base_color_texture = texture_slot(first, 0);
    m.metallic_roughness_texture = texture_slot(first, 1);
    m.normal_texture = texture_slot(first, 2);
    m.emissive_texture = texture_slot(first, 3);
    m.transmission_texture = texture_slot(first, 4);
    return m;
}

int light_of_surface(uint triangle) { return int(texelFetch(triangles, int(triangle)).w); }
