#include "measure/mirrored_light.h"

#include <algorithm>
#include <cmath>

#include "shaders/color.h"
#include "trace/bsdf.h"

namespace lw {
namespace {

constexpr int max_sheets = 8;
constexpr int max_reflections = 4;

float power_heuristic(float a, float b) { return a * a / (a * a + b * b); }

/// A surface that has the specular lobe of `s` and nothing else: a metal whose Fresnel factor, times the `k` that is
/// set here, is that of `s`: k (c + (1 - c) Schlick).
Surface specular_lobe(const SurfaceReader& reader, const Surface& s, float& k) {
    k = (1 - s.metallic) * s.specular + s.metallic;
    Surface lobe = s;
    lobe.base_color = (reader.dielectric_f0(s) * (1 - s.metallic) + s.base_color * s.metallic) / std::max(k, 1e-6f);
    lobe.metallic = 1;
    lobe.transmission = 0;
    return lobe;
}

vec3 turned(vec3 n, vec3 to_view) { return dot(n, to_view) < 0 ? -n : n; }

}  // namespace

void MirrorTracer::add_lamps(const Surface& s, vec3 n, vec3 to_view, vec3 part, uint object, Rng& rng,
                             MirroredLight& light) const {
    for (uint lamp = 0; lamp < scene_.lights.size(); ++lamp) {
        const float u = rng.next(), v = rng.next();
        const auto in = emitters_.arrive(lamp, s.position, u, v);
        if (!in || dot(in->to_light, n) <= 0) continue;
        const vec3 f = surfaces_.eval_brdf(s, n, to_view, in->to_light, false);
        if (!(largest(f) > 0)) continue;
        vec3 seen = part * f * in->radiance * powers_[lamp] * dot(in->to_light, n);
        if (in->pdf > 0) seen /= in->pdf;
        if (has_surface(scene_.lights[lamp].type))  // rays meet it too
            seen *= power_heuristic(in->pdf, bsdf_pdf(surfaces_, s, to_view, in->to_light));
        if (precise_luminance(seen) > 0)
            light[{lamp, object}] += precise_luminance(
                seen *
                caster_.transmittance(caster_.offset(s.position, turned(s.geometric_normal, to_view)), in->position));
    }
}

void MirrorTracer::reflect(const Surface& first, uint object, vec3 to_view, vec3 part, Rng& rng,
                           MirroredLight& light) const {
    Surface s = first;
    for (int reflections = 0; reflections < max_reflections; ++reflections) {
        float k = 0;
        const Surface lobe = specular_lobe(surfaces_, s, k);
        if (!(k > 0) || (s.flags & material_unlit)) return;
        part *= k;
        const vec3 ng = turned(s.geometric_normal, to_view);
        const vec3 n = dot(turned(s.normal, ng), to_view) > 1e-4f ? turned(s.normal, ng) : ng;
        add_lamps(lobe, n, to_view, part, object, rng, light);
        const std::optional<Scatter> next = sample_bsdf(surfaces_, lobe, to_view, Carries::radiance, rng);
        if (!next) return;
        part *= next->weight;
        vec3 origin = caster_.offset(s.position, ng);
        float distance = 0;
        for (int sheets = 0;; ++sheets) {
            const std::optional<Hit> hit = caster_.nearest(origin, next->direction, rng);
            if (!hit) return;
            s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
            distance += hit->distance;
            if (s.light >= 0) {
                const vec3 seen = part * emitters_.radiance(s, -next->direction) * powers_[size_t(s.light)];
                const float pdf = next->specular ? 0 : next->pdf;
                const float chosen =
                    pdf > 0 ? power_heuristic(pdf, emitters_.arrive_pdf(s, distance, next->direction)) : 1;
                if (precise_luminance(seen) > 0)
                    light[{uint(s.light), object}] += precise_luminance(seen) * double(chosen);
            }
            if (!surfaces_.passes_straight(s) || sheets == max_sheets) break;
            part *= surfaces_.passed_by(hit->triangle, hit->barycentrics, next->direction);
            origin = caster_.offset(s.position, turned(s.geometric_normal, next->direction));
        }
        to_view = -next->direction;
    }
}

void MirrorTracer::add(vec3 origin, vec3 direction, double share, Rng& rng, MirroredLight& light) const {
    vec3 part = vec3(float(share));
    for (int sheets = 0; sheets < max_sheets; ++sheets) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction, rng);
        if (!hit) return;
        const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
        if (s.light < 0) reflect(s, scene_.triangle_objects[hit->triangle], -direction, part, rng, light);
        if (!surfaces_.passes_straight(s)) return;
        part *= surfaces_.transmitted_part(s, std::abs(dot(s.normal, direction)), false);
        if (!(largest(part) > 0)) return;
        origin = caster_.offset(s.position, turned(s.geometric_normal, direction));
    }
}

}  // namespace lw
