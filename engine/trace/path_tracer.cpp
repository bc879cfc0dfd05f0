#include "trace/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int depth_of_roulette = 5;
constexpr int max_path = 1000;

}  // namespace

/// A vertex of a path: the surface there, and its normals on the side from which the path came.
struct PathTracer::Vertex {
    Vertex(const Surface& surface, vec3 towards) : s(surface), to_view(towards) {
        const float side = dot(s.geometric_normal, to_view) < 0 ? -1.0f : 1.0f;
        ng = s.geometric_normal * side;
        n = s.normal * side;
        if (dot(n, to_view) <= 1e-4f) n = ng;
    }
    const Surface& s;
    vec3 to_view, n, ng;
};

PathTracer::PathTracer(const Scene& scene, const RayCaster& caster, std::vector<vec3> powers, const SkySampler* sky)
    : scene_(scene), caster_(caster), surfaces_(scene), emitters_(scene), powers_(std::move(powers)), sky_(sky) {}

vec3 PathTracer::direct_from(uint light, const Vertex& at, Rng& rng) const {
    const float u = rng.next(), v = rng.next();
    std::optional<Incident> in = emitters_.arrive(light, at.s.position, u, v);
    if (!in) return vec3(0);
    in->radiance = powers_[light] * in->radiance;
    return reflected(at, *in, has_surface(scene_.lights[light].type));
}

vec3 PathTracer::reflected(const Vertex& at, const Incident& in, bool path_may_meet_it) const {
    const float cosine = dot(in.to_light, at.n), side = dot(in.to_light, at.ng);
    if (!(cosine * side > 0)) return vec3(0);
    const vec3 f = surfaces_.eval_bsdf(at.s, at.n, at.to_view, in.to_light);
    if (f.x + f.y + f.z <= 0) return vec3(0);
    const vec3 start = caster_.offset(at.s.position, side > 0 ? at.ng : -at.ng);
    const vec3 passed = caster_.transmittance(start, in.position);
    vec3 light_in = in.radiance * passed * f * std::abs(cosine);
    if (in.pdf > 0) light_in /= in.pdf;
    if (path_may_meet_it) light_in *= power_heuristic(in.pdf, bsdf_pdf(surfaces_, at.s, at.to_view, in.to_light));
    return light_in;
}

vec3 PathTracer::daylight(const Vertex& at, bool with_sun, Rng& rng) const {
    const float cell = rng.next(), u = rng.next(), v = rng.next();
    vec3 sum = reflected(at, sky_->arrive(at.s.position, {cell, u, v}), true);
    if (with_sun && sky_->has_sun()) {
        const float r = rng.next(), turn = rng.next();
        sum += reflected(at, sky_->arrive_from_sun(at.s.position, r, turn), true);
    }
    return sum;
}

vec3 PathTracer::direct(const Vertex& at, bool all_lamps, Rng& rng) const {
    const auto count = uint(scene_.lights.size());
    if (!all_lamps && count > 1) {
        const uint chosen = std::min(uint(rng.next() * float(count)), count - 1);
        return direct_from(chosen, at, rng) * float(count);
    }
    vec3 sum(0);
    for (uint light = 0; light < count; ++light) sum += direct_from(light, at, rng);
    return sum;
}

vec3 PathTracer::follow(vec3 origin, vec3 direction, float pdf, bool first, const Caustics* caustics, Rng& rng) const {
    vec3 sum(0), throughput(1), medium(0);
    float distance = 0;                          // m since the last vertex at which lamps were sampled
    bool scattered = !first, by_mirror = false;  // has met a surface that shows caustics, and what casts them after it
    for (int depth = 0; depth < max_path; ++depth) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction, rng);
        if (!hit) {
            if (sky_) sum += throughput * sky_->radiance(direction, pdf, !(caustics && scattered && by_mirror));
            break;
        }
        const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
        const Vertex at(s, -direction);
        throughput *= surfaces_.passed_by_medium(absorption_before(surfaces_, s, direction, medium), hit->distance);
        distance += hit->distance;
        if (s.flags & material_unlit) {
            if (first && depth == 0) sum += s.base_color;
            break;
        }
        if (s.light >= 0 && !(caustics && scattered && by_mirror)) {
            const vec3 emitted = emitters_.radiance(s, at.to_view) * powers_[size_t(s.light)];
            const float mis = pdf > 0 ? power_heuristic(pdf, emitters_.arrive_pdf(s, distance, direction)) : 1.0f;
            sum += throughput * emitted * mis;
        }
        const bool casts = caustics && casts_caustics(s);
        if (!(casts && scattered)) sum += throughput * direct(at, depth == 0, rng);
        if (sky_) sum += throughput * daylight(at, !(casts && scattered), rng);
        if (caustics) sum += throughput * caustics->reflected(surfaces_, s, at.n, at.ng, at.to_view);

        const std::optional<Scatter> next = sample_bsdf(surfaces_, s, at.to_view, Carries::radiance, rng);
        if (!next) break;
        throughput *= next->weight;
        if (depth >= depth_of_roulette) {
            const float survival = std::min(0.99f, std::max({throughput.x, throughput.y, throughput.z}));
            if (!(rng.next() < survival)) break;
            throughput /= survival;
        }
        direction = next->direction;
        medium = absorption_after(surfaces_, s, direction, medium);
        origin = caster_.offset(s.position, dot(direction, at.ng) > 0 ? at.ng : -at.ng);
        // A thin sheet that is passed straight on is no vertex: light sampling at the vertex before reaches through it.
        if (next->straight) continue;
        by_mirror = next->specular || casts;
        scattered = scattered || !by_mirror;
        pdf = next->specular ? 0.0f : next->pdf;
        distance = 0;
        // Light sampling at the next vertex covers one lamp in `count`; its pdf is only that of the choice of a point
        // because direct() multiplies by `count`: both strategies stay unbiased with the point pdf in the heuristic.
    }
    return sum;
}

vec3 PathTracer::radiance(vec3 origin, vec3 direction, Rng& rng, const Caustics* caustics) const {
    return follow(origin, direction, 0, true, caustics, rng);
}

vec3 PathTracer::irradiance(vec3 point, vec3 normal, Rng& rng, const Caustics* caustics) const {
    Surface white{};
    white.position = point;
    white.geometric_normal = white.normal = normal;
    white.base_color = vec3(1);
    white.roughness = 1;
    white.ior = 1.5f;
    white.light = -1;
    const Vertex at(white, normal);
    vec3 sum = direct(at, true, rng) * lw_pi;
    if (sky_) sum += daylight(at, true, rng) * lw_pi;
    if (caustics) sum += caustics->irradiance(point, normal);
    const float u = rng.next(), v = rng.next();
    const vec3 direction = frame_around(normal) * sample_cosine(u, v);
    const float pdf = std::max(dot(direction, normal), 0.0f) / lw_pi;
    if (!(pdf > 0)) return sum;
    return sum + lw_pi * follow(caster_.offset(point, normal), direction, pdf, false, caustics, rng);
}

}  // namespace lw
