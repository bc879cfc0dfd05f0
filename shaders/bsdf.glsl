// The reflecting part of the glTF 2.0 metallic-roughness BRDF (specification, appendix B.2-B.3) with
// KHR_materials_specular, _ior and _transmission. One text for C++ and GLSL; needs Surface from surface.glsl.

/// Fresnel reflectance at normal incidence of the dielectric base.
vec3 dielectric_f0(Surface s) LW_MEMBER {
    float r = (s.ior - 1.0f) / (s.ior + 1.0f);
    return min(s.specular_color * (r * r), vec3(1.0f)) * s.specular;
}

float schlick_weight(float cosine) LW_MEMBER {
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    float m2 = m * m;
    return m2 * m2 * m;
}

/// GGX distribution times the height-correlated Smith visibility V = G / (4 n.l n.v).
float ggx_d_v(float alpha, float nh, float nl, float nv) LW_MEMBER {
    float a2 = alpha * alpha;
    float t = nh * nh * (a2 - 1.0f) + 1.0f;
    float d = a2 / (lw_pi * t * t);
    float v = 0.5f / (nl * sqrt(nv * nv * (1.0f - a2) + a2) + nv * sqrt(nl * nl * (1.0f - a2) + a2));
    return d * v;
}

/// True when the surface reflects nothing but a mirror-like lobe or refracts: no photon is stored on it.
bool is_purely_specular(Surface s) LW_MEMBER {
    bool mirror = s.metallic > 0.999f && s.roughness * s.roughness < smallest_alpha;
    bool glass = s.transmission > 0.999f && s.metallic < 0.001f && s.roughness * s.roughness < smallest_alpha;
    return mirror || glass;
}

/// BRDF value f (1/sr, without cosine) for unit vectors to viewer and light, both on the side of `n`
/// (the shading normal turned to the viewer). Zero below the horizon. `diffuse_only` leaves the GGX lobe out.
vec3 eval_brdf(Surface s, vec3 n, vec3 to_view, vec3 to_light, bool diffuse_only) LW_MEMBER {
    float nl = dot(n, to_light);
    float nv = max(dot(n, to_view), 1e-4f);
    if (nl <= 0.0f || (s.flags & material_unlit) != 0u) return vec3(0.0f);
    vec3 diffuse = s.base_color * ((1.0f - s.metallic) * (1.0f - s.transmission) / lw_pi);
    if (diffuse_only) return diffuse;
    vec3 h = to_view + to_light;
    float h_length = length(h);
    h = h_length > 1e-6f ? h / h_length : n;
    float vh = clamp(dot(to_view, h), 0.0f, 1.0f);
    float weight = schlick_weight(vh);
    vec3 f0 = dielectric_f0(s);
    vec3 fresnel = f0 + (vec3(s.specular) - f0) * weight;
    float dielectric_diffuse = 1.0f - max(fresnel.x, max(fresnel.y, fresnel.z));
    vec3 metal_fresnel = s.base_color + (vec3(1.0f) - s.base_color) * weight;
    float alpha = s.roughness * s.roughness;
    float lobe = alpha < smallest_alpha ? 0.0f : ggx_d_v(alpha, clamp(dot(n, h), 0.0f, 1.0f), nl, nv);
    return diffuse * dielectric_diffuse + (fresnel * (1.0f - s.metallic) + metal_fresnel * s.metallic) * lobe;
}

/// Fraction of light that passes a thin transmissive sheet straight through (KHR_materials_transmission).
vec3 thin_transmittance(Surface s, float cosine) LW_MEMBER {
    vec3 f0 = dielectric_f0(s);
    vec3 fresnel = f0 + (vec3(s.specular) - f0) * schlick_weight(cosine);
    float passed = (1.0f - max(fresnel.x, max(fresnel.y, fresnel.z))) * s.transmission * (1.0f - s.metallic);
    return s.base_color * passed;
}

/// Directional albedo: the part of light from all sides alike that leaves towards the viewer, at cosine `nv` to the
/// normal. The GGX part is the fit of Karis 2014, "Physically based shading on mobile".
vec3 albedo_towards(Surface s, float nv) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return vec3(0.0f);
    vec4 r = s.roughness * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a004 = min(r.x * r.x, pow(2.0f, -9.28f * nv)) * r.x + r.y;
    float scale = -1.04f * a004 + r.z;
    float offset = 1.04f * a004 + r.w;
    vec3 dielectric = dielectric_f0(s) * scale + vec3(s.specular * offset);
    vec3 metal = s.base_color * scale + vec3(offset);
    float diffuse = (1.0f - max(dielectric.x, max(dielectric.y, dielectric.z))) * (1.0f - s.transmission);
    return (s.base_color * diffuse + dielectric) * (1.0f - s.metallic) + metal * s.metallic;
}
