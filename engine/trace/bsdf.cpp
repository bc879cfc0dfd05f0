#include "trace/bsdf.h"

#include <algorithm>
#include <cmath>

#include "shaders/color.h"
#include "shaders/photon_map.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float narrow_roughness = 0.12f;  // a lobe at this roughness is some 2 degrees wide
constexpr float min_share = 0.1f;  // least weight in the choice of a lobe of rough glass, whose Fresnel factor varies

/// The surface as one viewing direction sees it: normals on its side, and how often each lobe is sampled.
struct Lobes {
    vec3 n;            // shading normal towards the viewer
    vec3 ng;           // geometric normal towards the viewer
    bool inside;       // viewer inside a refracting volume
    bool delta;        // reflection so narrow that it is followed as a mirror
    bool delta_glass;  // transmission without spread
    float nv, alpha;
    float eta_view, eta_light;  // refractive indices before and behind
    vec3 mirror;                // reflectance of the specular lobe at normal `n`
    vec3 refraction;            // weight of the transmission at normal `n`
    float p_diffuse, p_glossy, p_transmit;
};

void share_samples(const SurfaceReader& reader, const Surface& s, Lobes& l) {
    float glossy = largest(l.mirror), transmit = largest(l.refraction);
    const float opaque = reader.passed_by_fresnel(reader.dielectric_fresnel(s, l.nv, l.inside)) * (1 - s.transmission);
    const float diffuse = largest(s.base_color) * std::max(opaque, 0.0f) * (1 - s.metallic);
    if (!l.delta && s.transmission > 0 && s.metallic < 1) {
        glossy = std::max(glossy, min_share);
        transmit = std::max(transmit, min_share);
    }
    const float sum = diffuse + glossy + transmit;
    if (!(sum > 0) || (s.flags & material_unlit)) return;
    l.p_diffuse = diffuse / sum, l.p_glossy = glossy / sum, l.p_transmit = transmit / sum;
}

Lobes lobes_at(const SurfaceReader& reader, const Surface& s, vec3 to_view) {
    Lobes l{};
    const bool front = dot(s.geometric_normal, to_view) >= 0;
    const float side = front ? 1.0f : -1.0f;
    l.ng = s.geometric_normal * side;
    l.n = s.normal * side;
    if (dot(l.n, to_view) <= 1e-4f) l.n = l.ng;
    l.nv = std::max(dot(l.n, to_view), 1e-4f);
    l.inside = !front && reader.refracts(s);
    const float behind = reader.refracts(s) ? s.ior : 1.0f;
    l.eta_view = l.inside ? behind : 1.0f;
    l.eta_light = l.inside ? 1.0f : behind;
    l.alpha = s.roughness * s.roughness;
    l.delta = l.alpha < min_alpha;
    l.delta_glass = reader.transmits_smoothly(s);
    l.mirror = reader.specular_reflectance(s, l.nv, l.inside);
    l.refraction = reader.transmitted_part(s, l.nv, l.inside);
    share_samples(reader, s, l);
    return l;
}

float reflected_pdf(const SurfaceReader& reader, const Lobes& l, vec3 h) {
    return reader.visible_normal_density(l.alpha, clamp(dot(l.n, h), 0.0f, 1.0f), l.nv) / 4;
}

/// Walter et al. 2007, equation 17.
float refracted_pdf(const SurfaceReader& reader, const Lobes& l, vec3 to_view, vec3 to_light) {
    const vec3 h = reader.refraction_half(l.n, to_view, to_light, l.eta_view, l.eta_light);
    const float vh = dot(to_view, h), lh = -dot(to_light, h);
    if (vh <= 0 || lh <= 0) return 0;
    const float root = l.eta_view * vh - l.eta_light * lh;
    const float density = reader.visible_normal_density(l.alpha, clamp(dot(l.n, h), 0.0f, 1.0f), l.nv) * vh;
    return density * l.eta_light * l.eta_light * lh / std::max(root * root, 1e-12f);
}

/// The pdf (per solid angle) of `to_light`, summed over all lobes that are not specular.
float smooth_pdf(const SurfaceReader& reader, const Surface& s, const Lobes& l, vec3 to_view, vec3 to_light) {
    const float nl = dot(l.n, to_light);
    if (nl < 0) {
        if (!(l.p_transmit > 0) || l.delta_glass) return 0;
        if (s.flags & material_thin)
            return l.p_transmit * reflected_pdf(reader, l, normalize(to_view + to_light - 2 * nl * l.n));
        return l.p_transmit * refracted_pdf(reader, l, to_view, to_light);
    }
    float pdf = l.p_diffuse * nl / lw_pi;
    if (l.p_glossy > 0 && !l.delta) pdf += l.p_glossy * reflected_pdf(reader, l, normalize(to_view + to_light));
    return pdf;
}

/// The refracted direction at a microfacet of normal `h`; nullopt when it reflects totally.
std::optional<vec3> transmitted(const SurfaceReader& reader, const Surface& s, const Lobes& l, vec3 to_view, vec3 h) {
    const float cosine = dot(h, to_view);
    if (s.flags & material_thin) {
        if (l.delta_glass) return -to_view;
        const vec3 reflected = 2 * cosine * h - to_view;
        if (dot(reflected, l.n) <= 0) return std::nullopt;
        return reflected - 2 * dot(reflected, l.n) * l.n;
    }
    const float eta = l.eta_view / l.eta_light, behind = reader.refracted_cosine(cosine, eta);
    if (behind < 0) return std::nullopt;
    return normalize((eta * cosine - behind) * h - eta * to_view);
}

/// A mirror direction or one through smooth glass.
std::optional<Scatter> sample_specular(const SurfaceReader& reader, const Surface& s, const Lobes& l, vec3 to_view,
                                       bool through) {
    if (!through) return Scatter{normalize(2 * l.nv * l.n - to_view), l.mirror / l.p_glossy, 0, true, false, true};
    const std::optional<vec3> direction = transmitted(reader, s, l, to_view, l.n);
    if (!direction) return std::nullopt;
    const float index = l.eta_view / l.eta_light;  // radiance is smaller in the thinner medium
    return Scatter{*direction, l.refraction * (index * index / l.p_transmit), 0, true, reader.passes_straight(s), true};
}

std::optional<Scatter> sample_smooth(const SurfaceReader& reader, const Surface& s, const Lobes& l, vec3 to_view,
                                     float choice, Rng& rng) {
    const float u = rng.next(), v = rng.next();
    const mat3 frame = frame_around(l.n);
    std::optional<vec3> direction;
    if (choice < l.p_transmit + l.p_glossy) {
        const vec3 h = frame * reader.sample_visible_normal(to_view * frame, l.alpha, sample_disc(u, v));
        direction = choice < l.p_transmit ? transmitted(reader, s, l, to_view, h) : 2 * dot(h, to_view) * h - to_view;
        if (!direction || (dot(*direction, l.n) < 0) != (choice < l.p_transmit)) return std::nullopt;
    } else {
        direction = frame * sample_cosine(u, v);
    }
    const float pdf = smooth_pdf(reader, s, l, to_view, *direction);
    if (!(pdf > 0)) return std::nullopt;
    const vec3 value = reader.eval_bsdf(s, l.n, to_view, *direction);
    return Scatter{*direction, value * (std::abs(dot(l.n, *direction)) / pdf),
                   pdf,        false,
                   false,      choice < l.p_transmit + l.p_glossy && s.roughness < narrow_roughness};
}

/// The factor between the weight of a photon and that of a path from the eye (Veach 1997, equations 5.13 and 5.18).
float adjoint_factor(const Lobes& l, vec3 to_view, vec3 direction) {
    const bool through = dot(direction, l.ng) < 0;
    const float index = through ? l.eta_light / l.eta_view : 1.0f;
    const float shading = l.nv * std::abs(dot(direction, l.ng));
    const float geometric = std::abs(dot(to_view, l.ng)) * std::abs(dot(direction, l.n));
    return index * index * (geometric > 1e-6f ? shading / geometric : 1.0f);
}

}  // namespace

bool has_narrow_lobe(const Surface& s) {
    return s.roughness < narrow_roughness && (s.specular > 0 || s.metallic > 0 || s.transmission > 0);
}

bool reflects_to_all_sides(const SurfaceReader& reader, const Surface& s) {
    return !reader.is_purely_specular(s) && (s.metallic <= 0.5f || s.roughness >= min_gathered_roughness);
}

std::optional<Scatter> sample_bsdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, Carries carries,
                                   Rng& rng) {
    const Lobes l = lobes_at(reader, s, to_view);
    const float choice = rng.next();
    if (l.p_diffuse + l.p_glossy + l.p_transmit <= 0) return std::nullopt;
    const bool through = choice < l.p_transmit, glossy = !through && choice < l.p_transmit + l.p_glossy;
    const bool specular = through ? l.delta_glass : glossy && l.delta;
    std::optional<Scatter> next =
        specular ? sample_specular(reader, s, l, to_view, through) : sample_smooth(reader, s, l, to_view, choice, rng);
    if (!next || (dot(next->direction, l.ng) < 0) != through)
        return std::nullopt;  // no light leaks through the surface where shading normals are bent
    if (carries == Carries::flux) next->weight *= adjoint_factor(l, to_view, next->direction);
    return next;
}

float bsdf_pdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, vec3 to_light) {
    return smooth_pdf(reader, s, lobes_at(reader, s, to_view), to_view, to_light);
}

vec3 absorption_before(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium) {
    return reader.refracts(s) && dot(s.geometric_normal, direction) > 0 ? s.absorption : medium;
}

vec3 absorption_after(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium) {
    if (!reader.refracts(s)) return medium;
    return dot(s.geometric_normal, direction) < 0 ? s.absorption : vec3(0);
}

}  // namespace lw
