#include "photons/photon_tracer.h"

#include <algorithm>
#include <cmath>

#include "shaders/color.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int max_path = 1000;  // most bounces of a path, for surfaces that absorb next to nothing: 0.99^1000 is 4e-5
constexpr int depth_of_roulette = 64;
constexpr size_t states_at_once = 8;  // paths traced side by side: while one waits for memory, others go on

/// The class of a path of class `path` after the bounce `next`. Light that goes straight on keeps its class, as shadow
/// rays pass there too.
uint path_after(uint path, const Scatter& next) {
    if (!next.narrow || path == path_indirect) return path_indirect;
    if (!next.specular || path == path_near_caustic) return path_near_caustic;
    return next.straight ? path : path_caustic;
}

}  // namespace

/// The state of a path between two surfaces.
struct PhotonTracer::PathState {
    vec3 origin, direction, flux;
    vec3 medium{0};  // absorption, 1/m
    vec3 reflector{0};
    uint reflector_side = no_reflector;
    uint light = 0, path = path_direct;
    int depth = 0;
    Rng rng{0, 0, 0};
    Hit next{};  // the surface it meets next
};

/// The surface that a path has met. Of a matte one only position, normals and base colour are filled in.
struct PhotonTracer::Bounce {
    Surface surface;
    uint triangle;
    bool matte, flat, back, shows_light;
};

PhotonTracer::PhotonTracer(const Scene& scene, const RayCaster& caster, const ShootSettings& settings)
    : scene_(scene),
      caster_(caster),
      surfaces_(scene),
      emitters_(scene),
      guides_(scene.lights.size()),
      packed_triangles_(pack_triangles(scene)),
      settings_(settings) {}

std::array<float, 5> PhotonTracer::numbers(uint light, uint64_t index) const {
    const auto scramble = uint32_t(mix64(settings_.seed * 0x10001 + light));
    std::array<float, 5> u;
    for (int d = 0; d < 5; ++d) u[size_t(d)] = sobol_owen(uint32_t(index), d, scramble);
    return u;
}

void PhotonTracer::trace(Chunk& chunk, double emitted, size_t most) const {
    std::array<PathState, states_at_once> states;
    size_t count = 0;
    const auto step_all = [&](const auto& step) {  // a path that ends is replaced by the last one of the array
        for (size_t i = 0; i < count;)
            if (step(states[i]))
                ++i;
            else
                states[i] = states[--count];
    };
    uint64_t next = chunk.first;
    while (true) {
        while (count < states.size() && next < chunk.last && chunk.photons.size() < most)
            states[count++] = start(chunk, next++, float(1.0 / emitted));
        if (count == 0) break;
        step_all([&](PathState& state) { return look(chunk, state); });
        step_all([&](PathState& state) { return bounce(chunk, state); });
    }
    chunk.last = next;
}

/// Starts path `index` of the chunk's lamp; `share`: its part of the lamp's flux.
PhotonTracer::PathState PhotonTracer::start(Chunk& chunk, uint64_t index, float share) const {
    std::array<float, 5> u = numbers(chunk.light, index);
    share *= guides_[chunk.light].warp(u);
    const Emission photon = emitters_.emit(chunk.light, u);
    PathState state{caster_.offset(photon.origin, photon.normal), photon.direction, photon.flux * share};
    state.light = chunk.light;
    state.rng = Rng(settings_.seed, chunk.light + 1, index);
    chunk.emitted_flux += precise_luminance(state.flux);
    return state;
}

/// Finds the next surface; returns false when the path leaves the scene. Blended surfaces that it passes get a photon
/// too.
bool PhotonTracer::look(Chunk& chunk, PathState& state) const {
    std::vector<Hit> passed;
    const std::optional<Hit> hit = caster_.nearest(state.origin, state.direction, state.rng, &passed);
    for (const Hit& blend : passed) {
        PathState there = state;
        there.flux = state.flux * surfaces_.passed_by_medium(state.medium, blend.distance);
        keep(chunk, there, bounce_at(blend, state.direction));
    }
    if (!hit) {
        chunk.escaped += precise_luminance(state.flux);
        return false;
    }
    state.next = *hit;
    __builtin_prefetch(&packed_triangles_[hit->triangle]);
    return true;
}

/// Stores a photon at the surface and sends the path on; returns false when it ends here.
bool PhotonTracer::bounce(Chunk& chunk, PathState& state) const {
    const Bounce at = bounce_at(state.next, state.direction);
    pass_medium(chunk, state, at);
    keep(chunk, state, at);
    if (!leave(chunk, state, at)) return false;
    if (++state.depth < max_path) return true;
    chunk.absorbed += precise_luminance(state.flux);
    return false;
}

/// Reduces the flux by the absorption of the medium on the way to `at`.
void PhotonTracer::pass_medium(Chunk& chunk, PathState& state, const Bounce& at) const {
    const vec3 absorption =
        at.matte ? state.medium : absorption_before(surfaces_, at.surface, state.direction, state.medium);
    if (absorption == vec3(0)) return;
    const vec3 arriving = state.flux * surfaces_.passed_by_medium(absorption, state.next.distance);
    chunk.absorbed += precise_luminance(state.flux) - precise_luminance(arriving);
    state.flux = arriving;
}

/// Stores a photon, unless the surface shows no photons (mirrors, clear glass).
void PhotonTracer::keep(Chunk& chunk, const PathState& state, const Bounce& at) const {
    if (!at.shows_light) return;
    ++chunk.shown;
    if (state.path == path_direct && !settings_.direct_in_photons) return;
    chunk.photons.push_back({at.surface.position, state.flux, -state.direction, at.triangle,
                             pack_origin(state.light, state.path, at.back), state.reflector, state.reflector_side});
}

PhotonTracer::Bounce PhotonTracer::bounce_at(const Hit& hit, vec3 direction) const {
    const PackedTriangle& packed = packed_triangles_[hit.triangle];
    Bounce at;
    at.triangle = hit.triangle;
    at.matte = packed.is_matte, at.flat = packed.is_flat;
    if (at.matte)
        read_matte(hit, packed, at.surface);
    else
        at.surface = surfaces_.surface_at(hit.triangle, hit.barycentrics);
    at.back = dot(at.surface.geometric_normal, direction) > 0;
    at.shows_light = at.matte || !surfaces_.is_purely_specular(at.surface);
    return at;
}

/// Fills in the members of `s` that a bounce at a matte surface needs, equal to those of surface_at().
void PhotonTracer::read_matte(const Hit& hit, const PackedTriangle& packed, Surface& s) const {
    const float b1 = hit.barycentrics.x, b2 = hit.barycentrics.y, b0 = 1 - b1 - b2;
    s.position = b0 * packed.corners[0] + b1 * packed.corners[1] + b2 * packed.corners[2];
    s.normal = s.geometric_normal = packed.normal;
    s.base_color = packed.base_color;
    if (packed.is_flat) return;
    const uvec3 c = scene_.triangles[hit.triangle];
    const vec3 n = b0 * scene_.normals[c.x] + b1 * scene_.normals[c.y] + b2 * scene_.normals[c.z];
    const float n_length = length(n);
    if (n_length > 1e-6f) s.normal = n / n_length;
    if (dot(s.normal, s.geometric_normal) < 0) s.normal = -s.normal;
}

void PhotonTracer::note_reflector(PathState& state, const Bounce& at) {
    state.reflector = at.surface.position;
    state.reflector_side = 2 * at.triangle + (at.back ? 1 : 0);
}

/// Samples the direction in which the path goes on; returns false when it ends, by absorption or Russian roulette.
bool PhotonTracer::leave(Chunk& chunk, PathState& state, const Bounce& at) const {
    if (at.matte) return leave_matte(chunk, state, at);
    const std::optional<Scatter> next = sample_bsdf(surfaces_, at.surface, -state.direction, Carries::flux, state.rng);
    // Beyond this depth roulette ends paths that are caught in clear glass.
    const float max_survival = state.depth < depth_of_roulette || (next && !next->specular) ? 1.0f : 0.95f;
    if (!survives(chunk, state, next ? next->weight : vec3(0), max_survival)) return false;
    state.path = path_after(state.path, *next);
    const bool passes = (dot(next->direction, at.surface.geometric_normal) < 0) != at.back;
    if (!next->narrow && !passes && reflects_to_all_sides(surfaces_, at.surface)) note_reflector(state, at);
    state.direction = next->direction;
    state.medium = absorption_after(surfaces_, at.surface, state.direction, state.medium);
    const vec3 ng = at.surface.geometric_normal;
    state.origin = caster_.offset(at.surface.position, dot(state.direction, ng) > 0 ? ng : -ng);
    return true;
}

/// Russian roulette: the path survives with a probability of at most `max_survival`, so that the flux that goes on is
/// on average `weight` times the arriving one. The flux of what ends counts as absorbed.
bool PhotonTracer::survives(Chunk& chunk, PathState& state, vec3 weight, float max_survival) {
    const vec3 reflected = state.flux * weight;
    const float before = largest(state.flux), after = largest(reflected);
    const float survival = before > 0 ? std::min(max_survival, after / before) : 0.0f;
    const bool goes_on = state.rng.next() < survival;
    const vec3 kept = goes_on ? reflected * (1 / survival) : vec3(0);
    chunk.absorbed += precise_luminance(state.flux) - precise_luminance(kept);
    state.flux = kept;
    return goes_on;
}

/// leave() for a Lambert reflector of one colour. Does what sample_bsdf() would do there, at less cost.
bool PhotonTracer::leave_matte(Chunk& chunk, PathState& state, const Bounce& at) const {
    const float side = at.back ? -1.0f : 1.0f;
    const vec3 ng = at.surface.geometric_normal * side, bent = at.surface.normal * side;
    const bool seen = -dot(bent, state.direction) > 1e-4f;
    const vec3 n(seen ? bent.x : ng.x, seen ? bent.y : ng.y, seen ? bent.z : ng.z);
    const float u = state.rng.next(), v = state.rng.next();
    const vec3 local = sample_cosine(u, v), direction = frame_around(n) * local;
    const float out = dot(ng, direction);
    // Flux at bent normals (Veach 1997, equation 5.18); none leaves through the surface.
    const float shading = std::max(-dot(n, state.direction), 1e-4f) * out;
    const float geometric = -dot(ng, state.direction) * local.z;
    const float adjoint = !(out > 0) ? 0.0f : geometric > 1e-6f && !at.flat ? shading / geometric : 1.0f;
    if (!survives(chunk, state, at.surface.base_color * adjoint, 1)) return false;
    state.path = path_indirect;
    note_reflector(state, at);
    state.direction = direction;
    state.origin = caster_.offset(at.surface.position, ng);
    return true;
}

}  // namespace lw
