// What lies at (triangle, barycentrics): position, normals and material parameters.
// One text for C++ and GLSL. The including scope provides the functions corner_position, corner_normal, corner_uv0,
// corner_uv1, corner_color, corner_tangent (triangle, 0 to 2), material_of, light_of_surface (triangle), texel_at,
// texture_at and the constants has_uv0, has_uv1, has_colors, has_tangents, has_textures (any),
// has_metallic_roughness_textures, has_emissive_textures, has_transmission_textures, has_alpha, has_transmission.

/// An sRGB code in [0, 1] to its linear value (IEC 61966-2-1). The power 2.4 as t^2 times a polynomial in sqrt(t),
/// fitted to a relative 5.8e-5, less than a hundredth of a step of 8 bits: twelve powers a look-up cost a fifth of a
/// frame where they are computed.
float srgb_to_linear(float c) LW_MEMBER {
    float t = (c + 0.055f) / 1.055f;
    float s = sqrt(t);
    float power = 0.042971207f + s * (1.26831497f + s * (-0.55774961f + s * (0.34058509f - 0.09412166f * s)));
    return c <= 0.04045f ? c / 12.92f : t * t * power;
}

int wrap_texel(int i, int size, uint mode) LW_MEMBER {
    if (mode == wrap_clamp) return clamp(i, 0, size - 1);
    int period = mode == wrap_mirror ? 2 * size : size;
    int j = i % period;
    if (j < 0) j += period;
    return j < size ? j : period - 1 - j;
}

vec4 fetch_texel(Texture t, int x, int y) LW_MEMBER {
    int column = wrap_texel(x, int(t.width), t.wrap_s);
    int row = wrap_texel(y, int(t.height), t.wrap_t);
    vec4 c = texel_at(t.first_texel + uint(row) * t.width + uint(column));
    if (t.srgb != 0u) c = vec4(srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z), c.w);
    return c;
}

/// Bilinear look-up of the base level, texel centres at half integers (glTF 2.0, section 3.8.4).
vec4 sample_texture(TextureSlot slot, vec2 first_uv, vec2 second_uv) LW_MEMBER {
    Texture t = texture_at(slot.texture);
    vec2 uv = slot.texcoord == 0u ? first_uv : second_uv;
    vec3 homogeneous = vec3(uv.x, uv.y, 1.0f);
    vec2 p = vec2(dot(slot.row0, homogeneous), dot(slot.row1, homogeneous));
    // Keeps the integer conversion in range; 2 is a whole number of periods of repeat and mirror.
    p.x = t.wrap_s == wrap_clamp ? clamp(p.x, -1.0f, 2.0f) : p.x - 2.0f * floor(p.x * 0.5f);
    p.y = t.wrap_t == wrap_clamp ? clamp(p.y, -1.0f, 2.0f) : p.y - 2.0f * floor(p.y * 0.5f);
    vec2 texel = p * vec2(float(t.width), float(t.height));
    if (t.nearest != 0u) return fetch_texel(t, int(floor(texel.x)), int(floor(texel.y)));
    texel = texel - 0.5f;
    vec2 base = floor(texel);
    vec2 f = texel - base;
    int x = int(base.x);
    int y = int(base.y);
    vec4 top = mix(fetch_texel(t, x, y), fetch_texel(t, x + 1, y), f.x);
    vec4 bottom = mix(fetch_texel(t, x, y + 1), fetch_texel(t, x + 1, y + 1), f.x);
    return mix(top, bottom, f.y);
}

/// The shading normal bent by the normal map of a surface at these weights of the three vertices.
vec3 mapped_normal(uint triangle, vec3 b, Material m, vec4 texel, vec3 normal) LW_MEMBER {
    vec3 local =
        vec3((texel.x * 2.0f - 1.0f) * m.normal_scale, (texel.y * 2.0f - 1.0f) * m.normal_scale, texel.z * 2.0f - 1.0f);
    vec4 tangent4 =
        b.x * corner_tangent(triangle, 0u) + b.y * corner_tangent(triangle, 1u) + b.z * corner_tangent(triangle, 2u);
    vec3 tangent = vec3(tangent4.x, tangent4.y, tangent4.z);
    tangent = tangent - normal * dot(normal, tangent);
    float tangent_length = length(tangent);
    if (tangent_length <= 1e-6f) return normal;
    tangent = tangent / tangent_length;
    vec3 bitangent = cross(normal, tangent) * (tangent4.w < 0.0f ? -1.0f : 1.0f);
    return normalize(local.x * tangent + local.y * bitangent + local.z * normal);
}

/// Multiplies what a surface got from its material by the material's textures, and bends its normal.
void apply_textures(uint triangle, vec3 b, Material m, LW_INOUT(Surface) s) LW_MEMBER {
    vec2 first_uv = vec2(0.0f);
    vec2 second_uv = vec2(0.0f);
    if (has_uv0)
        first_uv = b.x * corner_uv0(triangle, 0u) + b.y * corner_uv0(triangle, 1u) + b.z * corner_uv0(triangle, 2u);
    if (has_uv1)
        second_uv = b.x * corner_uv1(triangle, 0u) + b.y * corner_uv1(triangle, 1u) + b.z * corner_uv1(triangle, 2u);
    if (m.base_color_texture.texture >= 0) {
        vec4 c = sample_texture(m.base_color_texture, first_uv, second_uv);
        s.base_color *= vec3(c.x, c.y, c.z);
        s.alpha *= c.w;
    }
    if (has_metallic_roughness_textures && m.metallic_roughness_texture.texture >= 0) {
        vec4 c = sample_texture(m.metallic_roughness_texture, first_uv, second_uv);
        s.roughness *= c.y;
        s.metallic *= c.z;
    }
    if (has_emissive_textures && m.emissive_texture.texture >= 0) {
        vec4 c = sample_texture(m.emissive_texture, first_uv, second_uv);
        s.emissive *= vec3(c.x, c.y, c.z);
    }
    if (has_transmission_textures && m.transmission_texture.texture >= 0)
        s.transmission *= sample_texture(m.transmission_texture, first_uv, second_uv).x;
    if (has_tangents && m.normal_texture.texture >= 0)
        s.normal = mapped_normal(triangle, b, m, sample_texture(m.normal_texture, first_uv, second_uv), s.normal);
}

/// barycentrics are the weights of the second and third vertex.
Surface surface_at(uint triangle, vec2 barycentrics) LW_MEMBER {
    float b0 = 1.0f - barycentrics.x - barycentrics.y;
    float b1 = barycentrics.x;
    float b2 = barycentrics.y;
    vec3 p0 = corner_position(triangle, 0u);
    vec3 p1 = corner_position(triangle, 1u);
    vec3 p2 = corner_position(triangle, 2u);
    Material m = material_of(triangle);

    Surface s;
    s.position = b0 * p0 + b1 * p1 + b2 * p2;
    vec3 product = edge_product(p0, p1, p2);
    float twice_area = length(product);
    s.geometric_normal = twice_area > 0.0f ? product / twice_area : vec3(0.0f, 1.0f, 0.0f);
    vec3 n = b0 * corner_normal(triangle, 0u) + b1 * corner_normal(triangle, 1u) + b2 * corner_normal(triangle, 2u);
    float n_length = length(n);
    s.normal = n_length > 1e-6f ? n / n_length : s.geometric_normal;

    s.base_color = m.base_color;
    s.alpha = m.alpha;
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    s.emissive = m.emissive;
    s.specular = m.specular;
    s.specular_color = m.specular_color;
    s.ior = m.ior;
    s.transmission = m.transmission;
    s.absorption = m.absorption;
    s.flags = m.flags;
    s.light = light_of_surface(triangle);
    if (has_colors) {
        vec4 c = b0 * corner_color(triangle, 0u) + b1 * corner_color(triangle, 1u) + b2 * corner_color(triangle, 2u);
        s.base_color *= vec3(c.x, c.y, c.z);
        s.alpha *= c.w;
    }
    if (has_textures) apply_textures(triangle, vec3(b0, b1, b2), m, s);
    if (dot(s.normal, s.geometric_normal) < 0.0f) s.normal = -s.normal;
    return s;
}

/// How much of the surface is there: alpha of a blend; 0 or 1 by the cutoff of a mask; 1 of everything else.
float opacity_at(uint triangle, Surface s) LW_MEMBER {
    if (!has_alpha) return 1.0f;
    if ((s.flags & material_alpha_mask) != 0u) return s.alpha < material_of(triangle).alpha_cutoff ? 0.0f : 1.0f;
    return (s.flags & material_alpha_blend) != 0u ? clamp(s.alpha, 0.0f, 1.0f) : 1.0f;
}

/// True where a view ray passes: cut-out texels, and glass, which is looked straight through.
bool is_see_through(uint triangle, vec2 barycentrics) LW_MEMBER {
    Material m = material_of(triangle);
    bool cut_out = has_alpha && (m.flags & (material_alpha_mask | material_alpha_blend)) != 0u;
    if (!cut_out && !has_transmission) return false;
    Surface s = surface_at(triangle, barycentrics);
    if (has_transmission && s.transmission > 0.5f && s.metallic < 0.5f) return true;
    if (!cut_out) return false;
    return s.alpha < ((m.flags & material_alpha_mask) != 0u ? m.alpha_cutoff : 0.5f);
}

/// True where nothing of the surface is there to be seen.
bool is_hole(uint triangle, vec2 barycentrics) LW_MEMBER {
    if (!has_alpha || (material_of(triangle).flags & (material_alpha_mask | material_alpha_blend)) == 0u) return false;
    return opacity_at(triangle, surface_at(triangle, barycentrics)) <= 0.0f;
}
