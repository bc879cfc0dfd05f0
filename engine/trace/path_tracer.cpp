#include "trace/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int depth_of_roulette = 5;
constexpr int longest_path = 1000;

float power_heuristic(float a, float b) { return a * a / (a * a + b * b); }

}  // namespace

PathTracer::PathTracer(const Scene& scene, const RayCaster& caster, std::vector<vec3> weights)
    : scene_(scene), caster_(caster), surfaces_(scene), emitters_(scene), weights_(std::move(weights)) {}

vec3 PathTracer::direct_from(uint light, const Surface& s, vec3 n, vec3 ng, vec3 to_view, Rng& rng) const {
    const float u = rng.next(), v = rng.next();
    const std::optional<Incident> in = emitters_.arrive(light, s.position, u, v);
    if (!in || dot(in->to_light, ng) <= 0) return vec3(0);
    const float cosine = dot(in->to_light, n);
    if (cosine <= 0) return vec3(0);
    const vec3 f = surfaces_.eval_brdf(s, n, to_view, in->to_light, false);
    if (f.x + f.y + f.z <= 0) return vec3(0);
    const vec3 passed = caster_.transmittance(caster_.offset(s.position, ng), in->position);
    vec3 light_in = weights_[light] * in->radiance * passed * f * cosine;
    if (in->pdf > 0) light_in *= power_heuristic(in->pdf, bsdf_pdf(surfaces_, s, to_view, in->to_light)) / in->pdf;
    return light_in;
}

vec3 PathTracer::direct(const Surface& s, vec3 n, vec3 ng, vec3 to_view, bool all_lamps, Rng& rng) const {
    const auto count = uint(scene_.lights.size());
    if (!all_lamps && count > 1) {
        const uint chosen = std::min(uint(rng.next() * float(count)), count - 1);
        return direct_from(chosen, s, n, ng, to_view, rng) * float(count);
    }
    vec3 sum(0);
    for (uint light = 0; light < count; ++light) sum += direct_from(light, s, n, ng, to_view, rng);
    return sum;
}

vec3 PathTracer::follow(vec3 origin, vec3 direction, float pdf, bool first, Rng& rng) const {
    vec3 sum(0), throughput(1);
    for (int depth = 0; depth < longest_path; ++depth) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction);
        if (!hit) break;
        const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
        const vec3 to_view = -direction;
        if (s.flags & material_unlit) {
            if (first && depth == 0) sum += s.base_color;
            break;
        }
        if (s.light >= 0) {
            const vec3 emitted = emitters_.radiance(s, to_view) * weights_[size_t(s.light)];
            const float mis = pdf > 0 ? power_heuristic(pdf, emitters_.arrive_pdf(s, hit->distance, direction)) : 1.0f;
            sum += throughput * emitted * mis;
        }
        const float side = dot(s.geometric_normal, to_view) < 0 ? -1.0f : 1.0f;
        const vec3 ng = s.geometric_normal * side;
        vec3 n = s.normal * side;
        if (dot(n, to_view) <= 1e-4f) n = ng;
        sum += throughput * direct(s, n, ng, to_view, depth == 0, rng);

        const std::optional<Scatter> next = sample_bsdf(surfaces_, s, to_view, rng);
        if (!next) break;
        throughput *= next->weight;
        if (depth >= depth_of_roulette) {
            const float survival = std::min(0.99f, std::max({throughput.x, throughput.y, throughput.z}));
            if (!(rng.next() < survival)) break;
            throughput /= survival;
        }
        direction = next->direction;
        pdf = next->specular ? 0.0f : next->pdf;
        origin = caster_.offset(s.position, dot(direction, ng) > 0 ? ng : -ng);
        // Light sampling at the next vertex covers one lamp in `count`; its pdf is only that of the choice of a point
        // because direct() multiplies by `count`: both strategies stay unbiased with the point pdf in the heuristic.
    }
    return sum;
}

vec3 PathTracer::radiance(vec3 origin, vec3 direction, Rng& rng) const {
    return follow(origin, direction, 0, true, rng);
}

vec3 PathTracer::irradiance(vec3 point, vec3 normal, Rng& rng) const {
    Surface white{};
    white.position = point;
    white.geometric_normal = white.normal = normal;
    white.base_color = vec3(1);
    white.roughness = 1;
    white.ior = 1.5f;
    white.light = -1;
    const vec3 from_lamps = direct(white, normal, normal, normal, true, rng) * lw_pi;
    const float u = rng.next(), v = rng.next();
    const vec3 direction = frame_around(normal) * sample_cosine(u, v);
    const float pdf = std::max(dot(direction, normal), 0.0f) / lw_pi;
    if (!(pdf > 0)) return from_lamps;
    return from_lamps + lw_pi * follow(caster_.offset(point, normal), direction, pdf, false, rng);
}

}  // namespace lw
