// The glTF 2.0 metallic-roughness BRDF (specification, appendix B.2-B.3) with KHR_materials_specular, _ior,
// _transmission and _volume: reflection, thin sheets and refracting glass; single scattering, as the specification has
// it. One text for C++ and GLSL; needs Surface, surface.glsl, its arrays and its constants.

/// Fresnel reflectance at normal incidence of the dielectric base.
vec3 dielectric_f0(Surface s) LW_MEMBER {
    float r = (s.ior - 1.0f) / (s.ior + 1.0f);
    return min(s.specular_color * (r * r), vec3(1.0f)) * s.specular;
}

/// True for the boundary of a transmissive volume, where light refracts; false for thin sheets and opaque surfaces.
bool refracts(Surface s) LW_MEMBER {
    return has_transmission && s.transmission > 0.0f && s.metallic < 1.0f && (s.flags & material_thin) == 0u;
}

/// Cosine behind a refracting surface met at `cosine`, `eta` = index on this side / index behind it; negative when the
/// reflection is total.
float refracted_cosine(float cosine, float eta) LW_MEMBER {
    float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    return k > 0.0f ? sqrt(k) : -1.0f;
}

float schlick_weight(float cosine) LW_MEMBER {
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    float m2 = m * m;
    return m2 * m2 * m;
}

/// Fresnel reflectance of the dielectric met at `cosine`. From inside a volume Schlick's cosine is that of the
/// refracted ray, so that both directions through a surface agree; beyond the critical angle everything is reflected.
vec3 dielectric_fresnel(Surface s, float cosine, bool inside) LW_MEMBER {
    vec3 f0 = dielectric_f0(s);
    if (inside) cosine = refracted_cosine(cosine, s.ior);
    return cosine < 0.0f ? vec3(1.0f) : f0 + (vec3(s.specular) - f0) * schlick_weight(cosine);
}

/// The part of the light that is not reflected, equal for all channels (appendix B.3.4).
float passed_by_fresnel(vec3 fresnel) LW_MEMBER { return 1.0f - max(fresnel.x, max(fresnel.y, fresnel.z)); }

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
    bool mirror = s.metallic > 0.999f && s.roughness * s.roughness < min_alpha;
    bool glass = s.transmission > 0.999f && s.metallic < 0.001f && s.roughness * s.roughness < min_alpha;
    return mirror || glass;
}

/// Reflectance of the specular lobe at `cosine` between the viewer and the microfacet normal.
vec3 specular_reflectance(Surface s, float cosine, bool inside) LW_MEMBER {
    vec3 metal = s.base_color + (vec3(1.0f) - s.base_color) * schlick_weight(cosine);
    return dielectric_fresnel(s, cosine, inside) * (1.0f - s.metallic) + metal * s.metallic;
}

/// Samples a visible normal of GGX (Heitz 2018). `view` and the result are in the frame of the surface, normal +Z;
/// `disc`: uniform in the unit disc.
vec3 sample_visible_normal(vec3 view, float alpha, vec2 disc) LW_MEMBER {
    vec3 vh = normalize(vec3(alpha * view.x, alpha * view.y, view.z));
    float length2 = vh.x * vh.x + vh.y * vh.y;
    vec3 t1 = length2 > 0.0f ? vec3(-vh.y, vh.x, 0.0f) / sqrt(length2) : vec3(1.0f, 0.0f, 0.0f);
    vec3 t2 = cross(vh, t1);
    float blend = 0.5f * (1.0f + vh.z);
    float y = (1.0f - blend) * sqrt(max(0.0f, 1.0f - disc.x * disc.x)) + blend * disc.y;
    vec3 h = disc.x * t1 + y * t2 + sqrt(max(0.0f, 1.0f - disc.x * disc.x - y * y)) * vh;
    return normalize(vec3(alpha * h.x, alpha * h.y, max(1e-6f, h.z)));
}

/// D_v(h) / (v.h): the density of the visible normals without the cosine to the viewer.
float visible_normal_density(float alpha, float nh, float nv) LW_MEMBER {
    float a2 = alpha * alpha;
    float t = nh * nh * (a2 - 1.0f) + 1.0f;
    float d = a2 / (lw_pi * t * t);
    float g1 = 2.0f * nv / (nv + sqrt(a2 + (1.0f - a2) * nv * nv));
    return g1 * d / nv;
}

/// Solid-angle density of the reflections of a lobe sampled by its visible normals; 0 for mirrors.
float lobe_pdf(Surface s, vec3 n, vec3 to_view, vec3 to_light) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    vec3 h = to_view + to_light;
    float h_length = length(h);
    if (alpha < min_alpha || h_length < 1e-6f) return 0.0f;
    return visible_normal_density(alpha, clamp(dot(n, h) / h_length, 0.0f, 1.0f), max(dot(n, to_view), 1e-4f)) / 4.0f;
}

/// Value of a BRDF (1/sr, without cosine), by lobe.
struct BrdfParts {
    vec3 diffuse;
    vec3 specular;
};

BrdfParts brdf_parts(Surface s, vec3 n, vec3 to_view, vec3 to_light) LW_MEMBER {
    BrdfParts f;
    f.diffuse = vec3(0.0f);
    f.specular = vec3(0.0f);
    float nl = dot(n, to_light);
    float nv = max(dot(n, to_view), 1e-4f);
    if (nl <= 0.0f || (s.flags & material_unlit) != 0u) return f;
    vec3 h = to_view + to_light;
    float h_length = length(h);
    h = h_length > 1e-6f ? h / h_length : n;
    float vh = clamp(dot(to_view, h), 0.0f, 1.0f);
    vec3 fresnel = dielectric_fresnel(s, vh, refracts(s) && dot(s.geometric_normal, to_view) < 0.0f);
    float dielectric_diffuse = passed_by_fresnel(fresnel);
    vec3 metal_fresnel = s.base_color + (vec3(1.0f) - s.base_color) * schlick_weight(vh);
    float alpha = s.roughness * s.roughness;
    float lobe = alpha < min_alpha ? 0.0f : ggx_d_v(alpha, clamp(dot(n, h), 0.0f, 1.0f), nl, nv);
    f.diffuse = s.base_color * ((1.0f - s.metallic) * (1.0f - s.transmission) / lw_pi) * dielectric_diffuse;
    f.specular = (fresnel * (1.0f - s.metallic) + metal_fresnel * s.metallic) * lobe;
    return f;
}

/// BRDF value f (1/sr, without cosine) for unit vectors to viewer and light, both on the side of `n`
/// (the shading normal turned to the viewer). Zero below the horizon. `diffuse_only` leaves the GGX lobe out.
vec3 eval_brdf(Surface s, vec3 n, vec3 to_view, vec3 to_light, bool diffuse_only) LW_MEMBER {
    if (diffuse_only) {
        if (dot(n, to_light) <= 0.0f || (s.flags & material_unlit) != 0u) return vec3(0.0f);
        return s.base_color * ((1.0f - s.metallic) * (1.0f - s.transmission) / lw_pi);
    }
    BrdfParts f = brdf_parts(s, n, to_view, to_light);
    return f.diffuse + f.specular;
}

/// True when a thin sheet transmits light without a change of direction. Shadow rays pass it, and light through it
/// still counts as direct.
bool passes_straight(Surface s) LW_MEMBER {
    return (s.flags & material_thin) != 0u && s.roughness * s.roughness < min_alpha;
}

/// True when the transmission has no spread: smooth, or a volume of the index of air, which bends nothing.
bool transmits_smoothly(Surface s) LW_MEMBER {
    return s.roughness * s.roughness < min_alpha || (refracts(s) && abs(s.ior - 1.0f) < 1e-3f);
}

/// The part of the light at `cosine` that the transmission lobe transmits, roughness aside.
vec3 transmitted_part(Surface s, float cosine, bool inside) LW_MEMBER {
    float passed = passed_by_fresnel(dielectric_fresnel(s, cosine, inside));
    return s.base_color * (passed * s.transmission * (1.0f - s.metallic));
}

/// Half vector of a refraction, on the side of the viewer (Walter et al. 2007, equation 16).
/// eta_view, eta_light: refractive indices on the two sides.
vec3 refraction_half(vec3 n, vec3 to_view, vec3 to_light, float eta_view, float eta_light) LW_MEMBER {
    vec3 h = eta_view * to_view + eta_light * to_light;
    float h_length = length(h);
    if (h_length < 1e-6f) return n;
    h = h / h_length;
    return dot(h, n) < 0.0f ? -h : h;
}

/// Value (1/sr, without cosine) of the transmission of a rough sheet or volume, for a light on the far side of `n`.
/// Radiance: seen from the thinner medium it is smaller by the square of the refractive index (Walter et al. 2007,
/// equation 21). Zero for smooth glass, which has no value, only samples.
vec3 eval_btdf(Surface s, vec3 n, vec3 to_view, vec3 to_light) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    float nl = -dot(n, to_light);
    float nv = max(dot(n, to_view), 1e-4f);
    if (nl <= 0.0f || s.transmission <= 0.0f || transmits_smoothly(s) || (s.flags & material_unlit) != 0u)
        return vec3(0.0f);
    if ((s.flags & material_thin) != 0u) {  // the reflection mirrored to the other side
        vec3 h = normalize(to_view + to_light + 2.0f * nl * n);
        return transmitted_part(s, clamp(dot(to_view, h), 0.0f, 1.0f), false) *
               ggx_d_v(alpha, clamp(dot(n, h), 0.0f, 1.0f), nl, nv);
    }
    bool inside = dot(s.geometric_normal, to_view) < 0.0f;
    float eta_view = inside ? s.ior : 1.0f;
    float eta_light = inside ? 1.0f : s.ior;
    vec3 h = refraction_half(n, to_view, to_light, eta_view, eta_light);
    float vh = dot(to_view, h);
    float lh = -dot(to_light, h);
    if (vh <= 0.0f || lh <= 0.0f) return vec3(0.0f);
    float root = eta_view * vh - eta_light * lh;
    float scale = 4.0f * vh * lh * eta_view * eta_view / max(root * root, 1e-12f);
    return transmitted_part(s, vh, inside) * (ggx_d_v(alpha, clamp(dot(n, h), 0.0f, 1.0f), nl, nv) * scale);
}

/// BRDF or BTDF, whichever side of `n` the light is on.
vec3 eval_bsdf(Surface s, vec3 n, vec3 to_view, vec3 to_light) LW_MEMBER {
    if (has_transmission && dot(n, to_light) < 0.0f) return eval_btdf(s, n, to_view, to_light);
    return eval_brdf(s, n, to_view, to_light, false);
}

/// Part of the light left after `distance` m in a medium of `absorption` 1/m (Beer-Lambert).
vec3 passed_by_medium(vec3 absorption, float distance) LW_MEMBER { return exp(-absorption * distance); }

/// Fraction of light, per RGB, that passes straight through a triangle: holes, blends and thin smooth sheets. The rest
/// is reflected, scattered or refracted; photons and paths account for it.
vec3 passed_by(uint triangle, vec2 barycentrics, vec3 direction) LW_MEMBER {
    Surface s = surface_at(triangle, barycentrics);
    vec3 passed = vec3(0.0f);
    if (has_transmission && passes_straight(s))
        passed = transmitted_part(s, max(abs(dot(s.normal, direction)), 1e-4f), false);
    return mix(vec3(1.0f), passed, opacity_at(triangle, s));
}

/// Directional albedo of the GGX lobe, the part of light from all sides alike that leaves at cosine `nv` to the normal,
/// as F0 times x and Schlick's rise to 1 times y. Polynomials fitted to integrals of ggx_d_v: x + y to 0.03, to 0.02 of
/// surfaces rougher than 0.7; y to 0.04 and 0.005.
vec2 lobe_albedo(float roughness, float nv) LW_MEMBER {
    float r = roughness;
    float lost =
        r * ((0.7f + nv * (-3.404f + nv * 3.086f)) +
             r * ((-1.479f + nv * (12.805f - nv * 14.306f)) +
                  r * ((1.026f + nv * (-12.407f + nv * 18.13f)) + r * (-0.092f + nv * (4.066f - nv * 7.454f)))));
    float rise = (1.163f - 0.75f * nv) +
                 r * ((-2.95f + 17.54f * nv) +
                      r * ((1.296f - 51.378f * nv) + r * ((2.105f + 54.343f * nv) + r * (-1.581f - 19.724f * nv))));
    rise = clamp(rise * schlick_weight(nv), 0.0f, 1.0f);
    return vec2(clamp(1.0f - lost - rise, 0.0f, 1.0f), rise);
}

/// The part of light from all sides alike that the diffuse lobe alone sends to the viewer, at cosine `nv` to the
/// normal: what Fresnel's factor passes, averaged over the hemisphere (the mean of Schlick's weight, fitted to 0.0002).
vec3 diffuse_albedo_towards(Surface s, float nv) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return vec3(0.0f);
    vec3 f0 = dielectric_f0(s);
    float m = (1.0f - nv) * (1.0f - nv);
    float mean_weight = 0.0160f * m + 0.0120f * m * m;
    float passed = passed_by_fresnel(f0 + (vec3(s.specular) - f0) * mean_weight);
    return s.base_color * (passed * (1.0f - s.metallic) * (1.0f - s.transmission));
}

/// Directional albedo: the part of light from all sides alike that both lobes send to the viewer, at cosine `nv` to the
/// normal.
vec3 albedo_towards(Surface s, float nv) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return vec3(0.0f);
    vec2 lobe = lobe_albedo(s.roughness, nv);
    vec3 dielectric = dielectric_f0(s) * lobe.x + vec3(s.specular * lobe.y);
    vec3 metal = s.base_color * lobe.x + vec3(lobe.y);
    return diffuse_albedo_towards(s, nv) + dielectric * (1.0f - s.metallic) + metal * s.metallic;
}
