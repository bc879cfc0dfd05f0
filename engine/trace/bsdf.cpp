#include "trace/bsdf.h"

#include <algorithm>
#include <cmath>

#include "trace/sampling.h"

namespace lw {
namespace {

float largest(vec3 v) { return std::max({v.x, v.y, v.z}); }

/// The surface as one viewing direction sees it: normals on its side, and how often each lobe is sampled.
struct Lobes {
    vec3 n;             // shading normal towards the viewer
    vec3 ng;            // geometric normal towards the viewer
    bool entering;      // viewer on the front side
    bool delta_mirror;  // GGX lobe so narrow that it is followed as a mirror
    float nv;
    vec3 mirror;      // reflectance of the specular lobe at normal `n`
    vec3 refraction;  // weight of the transmission
    float p_diffuse, p_glossy, p_transmit;
};

vec3 specular_reflectance(const SurfaceReader& reader, const Surface& s, float cosine) {
    const float weight = reader.schlick_weight(cosine);
    const vec3 f0 = reader.dielectric_f0(s);
    const vec3 dielectric = f0 + (vec3(s.specular) - f0) * weight;
    const vec3 metal = s.base_color + (vec3(1) - s.base_color) * weight;
    return dielectric * (1 - s.metallic) + metal * s.metallic;
}

/// Cosine of the refracted ray, or a negative number for total internal reflection.
float refracted_cosine(float cosine, float eta) {
    const float k = 1 - eta * eta * (1 - cosine * cosine);
    return k > 0 ? std::sqrt(k) : -1.0f;
}

Lobes lobes_at(const SurfaceReader& reader, const Surface& s, vec3 to_view) {
    Lobes l{};
    l.entering = dot(s.geometric_normal, to_view) >= 0;
    const float side = l.entering ? 1.0f : -1.0f;
    l.ng = s.geometric_normal * side;
    l.n = s.normal * side;
    if (dot(l.n, to_view) <= 1e-4f) l.n = l.ng;
    l.nv = std::max(dot(l.n, to_view), 1e-4f);
    const bool thin = (s.flags & material_thin) != 0;
    float cosine = l.nv;
    if (s.transmission > 0 && !thin && !l.entering) cosine = refracted_cosine(l.nv, s.ior);  // Schlick from inside
    const bool total = cosine < 0;
    l.mirror = total ? vec3(1) : specular_reflectance(reader, s, cosine);
    l.delta_mirror = s.roughness * s.roughness < smallest_alpha;
    const float passing = total ? 0.0f : (1 - largest(l.mirror)) * (1 - s.metallic);
    l.refraction = s.base_color * (passing * s.transmission);
    const float diffuse = largest(s.base_color) * passing * (1 - s.transmission);
    const float glossy = largest(l.mirror), transmit = largest(l.refraction);
    const float sum = diffuse + glossy + transmit;
    if (!(sum > 0) || (s.flags & material_unlit)) return l;
    l.p_diffuse = diffuse / sum, l.p_glossy = glossy / sum, l.p_transmit = transmit / sum;
    return l;
}

/// Visible normals of GGX (Heitz 2018), local frame, alpha isotropic.
vec3 sample_visible_normal(vec3 view, float alpha, float u, float v) {
    const vec3 vh = normalize(vec3(alpha * view.x, alpha * view.y, view.z));
    const float length2 = vh.x * vh.x + vh.y * vh.y;
    const vec3 t1 = length2 > 0 ? vec3(-vh.y, vh.x, 0) / std::sqrt(length2) : vec3(1, 0, 0);
    const vec3 t2 = cross(vh, t1);
    const vec2 d = sample_disc(u, v);
    const float blend = 0.5f * (1 + vh.z);
    const float y = (1 - blend) * std::sqrt(std::max(0.0f, 1 - d.x * d.x)) + blend * d.y;
    const vec3 h = d.x * t1 + y * t2 + std::sqrt(std::max(0.0f, 1 - d.x * d.x - y * y)) * vh;
    return normalize(vec3(alpha * h.x, alpha * h.y, std::max(1e-6f, h.z)));
}

float visible_normal_pdf(float alpha, float nh, float nv) {
    const float a2 = alpha * alpha;
    const float t = nh * nh * (a2 - 1) + 1;
    const float d = a2 / (lw_pi * t * t);
    const float g1 = 2 * nv / (nv + std::sqrt(a2 + (1 - a2) * nv * nv));
    return g1 * d / (4 * nv);  // of the reflected direction: D_v(h) / (4 v.h)
}

float smooth_pdf(const Surface& s, const Lobes& l, vec3 to_view, vec3 to_light) {
    const float nl = dot(l.n, to_light);
    if (nl <= 0) return 0;
    float pdf = l.p_diffuse * nl / lw_pi;
    if (l.p_glossy > 0 && !l.delta_mirror) {
        const vec3 h = normalize(to_view + to_light);
        pdf += l.p_glossy * visible_normal_pdf(s.roughness * s.roughness, clamp(dot(l.n, h), 0.0f, 1.0f), l.nv);
    }
    return pdf;
}

Scatter transmit(const Surface& s, const Lobes& l, vec3 to_view, Rng& rng) {
    const vec3 weight = l.refraction / l.p_transmit;
    vec3 n = l.n;
    if (!l.delta_mirror) {  // rough glass: a visible microfacet takes the place of the normal
        const mat3 frame = frame_around(l.n);
        const float u = rng.next(), v = rng.next();
        n = frame * sample_visible_normal(to_view * frame, s.roughness * s.roughness, u, v);
    }
    if (s.flags & material_thin) {
        const vec3 mirrored = 2 * dot(n, to_view) * n - to_view;
        return {l.delta_mirror ? -to_view : mirrored - 2 * dot(mirrored, l.n) * l.n, weight, 0, true};
    }
    const float eta = l.entering ? 1 / s.ior : s.ior;
    const float cosine = dot(n, to_view), inside = refracted_cosine(cosine, eta);
    if (inside < 0) return {2 * cosine * n - to_view, weight, 0, true};
    return {normalize((eta * cosine - inside) * n - eta * to_view), weight, 0, true};
}

}  // namespace

std::optional<Scatter> sample_bsdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, Rng& rng) {
    const Lobes l = lobes_at(reader, s, to_view);
    const float choice = rng.next();
    if (l.p_diffuse + l.p_glossy + l.p_transmit <= 0) return std::nullopt;
    if (choice < l.p_transmit) return transmit(s, l, to_view, rng);
    const float u = rng.next(), v = rng.next();
    const mat3 frame = frame_around(l.n);
    if (choice < l.p_transmit + l.p_glossy) {
        if (l.delta_mirror) {
            const vec3 direction = 2 * l.nv * l.n - to_view;
            if (dot(direction, l.ng) <= 0) return std::nullopt;
            return Scatter{normalize(direction), l.mirror / l.p_glossy, 0, true};
        }
        const vec3 h = frame * sample_visible_normal(to_view * frame, s.roughness * s.roughness, u, v);
        const vec3 direction = 2 * dot(h, to_view) * h - to_view;
        if (dot(direction, l.ng) <= 0 || dot(direction, l.n) <= 0) return std::nullopt;
        const float pdf = smooth_pdf(s, l, to_view, direction);
        if (!(pdf > 0)) return std::nullopt;
        return Scatter{direction, reader.eval_brdf(s, l.n, to_view, direction, false) * (dot(l.n, direction) / pdf),
                       pdf, false};
    }
    const vec3 direction = frame * sample_cosine(u, v);
    if (dot(direction, l.ng) <= 0) return std::nullopt;
    const float pdf = smooth_pdf(s, l, to_view, direction);
    if (!(pdf > 0)) return std::nullopt;
    return Scatter{direction, reader.eval_brdf(s, l.n, to_view, direction, false) * (dot(l.n, direction) / pdf), pdf,
                   false};
}

float bsdf_pdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, vec3 to_light) {
    return smooth_pdf(s, lobes_at(reader, s, to_view), to_view, to_light);
}

}  // namespace lw
