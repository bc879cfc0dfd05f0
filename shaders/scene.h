// Scene records shared by C++ and GLSL (scalar layout, 4-byte members only).
// Metres, right-handed, Y up; linear Rec. 709; photometric: candela, lux, cd/m2.
#ifndef LW_SCENE_H
#define LW_SCENE_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint no_triangle = 0xffffffffu;  // in the place of the number of a triangle

LW_CONST uint light_point = 0u;        // intensity in cd
LW_CONST uint light_spot = 1u;         // intensity in cd inside the inner cone
LW_CONST uint light_directional = 2u;  // intensity in lx on a plane facing the light
LW_CONST uint light_mesh = 3u;         // intensity in cd/m2
LW_CONST uint light_profile = 4u;      // intensity in cd in the strongest direction of its table

LW_CONST uint material_double_sided = 1u;  // emits from both sides
LW_CONST uint material_unlit = 2u;         // shows base colour x 1 cd/m2, reflects no light
LW_CONST uint material_alpha_mask = 4u;
LW_CONST uint material_alpha_blend = 8u;
LW_CONST uint material_thin = 16u;  // transmission without refraction (no volume behind the surface)
LW_CONST uint lobe_is_followed =
    32u;  // of a Surface alone: rays bring what its specular lobe reflects, but for small lamps

LW_CONST uint wrap_repeat = 0u;
LW_CONST uint wrap_clamp = 1u;
LW_CONST uint wrap_mirror = 2u;

/// Reference to a texture from a material; texture < 0 means none.
/// uv' = (dot(row0, (u, v, 1)), dot(row1, (u, v, 1))) as KHR_texture_transform.
struct TextureSlot {
    int texture;
    uint texcoord;  // 0 or 1
    vec3 row0;
    vec3 row1;
};

/// RGBA8 texels lie at [first_texel, first_texel + width * height), row 0 first, R in the low byte.
struct Texture {
    uint first_texel;
    uint width;
    uint height;
    uint wrap_s;
    uint wrap_t;
    uint srgb;     // 1: colour channels are sRGB encoded
    uint nearest;  // 1: no bilinear filter
};

/// glTF 2.0 metallic-roughness material with KHR_materials_specular, _ior, _transmission, _volume, _emissive_strength.
struct Material {
    vec3 base_color;
    float alpha;
    vec3 emissive;  // cd/m2, emissiveFactor x emissiveStrength
    float metallic;
    vec3 specular_color;
    float roughness;  // glTF roughness, alpha = roughness^2
    float specular;
    float ior;
    float transmission;
    float alpha_cutoff;
    float normal_scale;
    uint flags;
    vec3 absorption;  // 1/m inside a volume, from attenuationColor and attenuationDistance
    TextureSlot base_color_texture;
    TextureSlot metallic_roughness_texture;
    TextureSlot normal_texture;
    TextureSlot emissive_texture;
    TextureSlot transmission_texture;
};

/// One primitive of one node instance.
struct Object {
    uint material;
    int light;  // the light whose mesh this is, or -1
};

/// A lamp the user can dim. `intensity` is its RGB power in its own unit; photons are stored for intensity 1.
struct Light {
    uint type;
    vec3 intensity;
    vec3 position;
    vec3 direction;  // unit, the way light travels (spot axis, directional)
    float cos_inner;
    float cos_outer;
    uint first_emitter;  // range in the list of emissive triangles (mesh lights)
    uint emitter_count;
    float area;    // m2 of emissive surface, both sides counted when double-sided
    vec3 across;   // unit, C0 of the table; `direction` is its aim (profile lights)
    uint profile;  // first word of the table in the array of texels, see profile.glsl
};

/// A triangle of an emissive mesh. Points on a lamp are picked by area: area_below is that of this and all earlier
/// triangles of the lamp, m2, one side.
struct Emitter {
    uint triangle;
    float area_below;
};

/// The cross product of two edges of a triangle: along the normal of its front, as long as twice its area.
LW_INLINE vec3 edge_product(vec3 a, vec3 b, vec3 c) { return cross(b - a, c - a); }

/// Smallest GGX alpha that is evaluated as a lobe; smoother surfaces are followed as mirrors.
LW_CONST float min_alpha = 1e-3f;

/// The surface as the BRDF sees it.
struct Surface {
    vec3 position;
    vec3 geometric_normal;  // unit, of the front face
    vec3 normal;            // unit shading normal, on the side of geometric_normal
    vec3 base_color;
    float alpha;
    float metallic;
    float roughness;
    vec3 emissive;  // cd/m2
    float specular;
    vec3 specular_color;
    float ior;
    float transmission;
    vec3 absorption;  // 1/m, behind the surface
    uint flags;
    int light;
};

#ifdef __cplusplus
static_assert(sizeof(TextureSlot) == 32 && sizeof(Texture) == 28);
static_assert(sizeof(Material) == 84 + 5 * 32 && offsetof(Material, base_color_texture) == 84);
static_assert(sizeof(Object) == 8 && sizeof(Emitter) == 8 && sizeof(Light) == 76 && offsetof(Light, profile) == 72);
}  // namespace lw
#endif
#endif
