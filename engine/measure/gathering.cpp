#include "measure/gathering.h"

#include <algorithm>
#include <cmath>

#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int max_path = 64;
constexpr float min_used_coverage = 0.75f;
/// Least roughness of a lobe that reflects photons. Rays average the noise of narrow lobes, so it is lower than in a
/// picture: a wider lobe loses light at grazing angles.
constexpr float min_reflected_roughness = 0.2f;
constexpr float min_direct_roughness = 0.1f;  // least roughness for lamps, so that a mirror-like coat shows them

/// The power heuristic: weight of a sample of pdf `own` that another technique would draw with pdf `other`.
float share_of(float own, float other) { return own * own / (own * own + other * other); }

}  // namespace

void PhotonShares::add(uint reference, ChannelLux value) {
    if (!(value.x + value.y + value.z > 0)) return;
    if (lux[reference] == vec3(0)) touched.push_back(reference);
    lux[reference] += value;
}

void PhotonShares::clear() {
    for (const uint reference : touched) lux[reference] = vec3(0);
    touched.clear();
}

void Gatherer::add_emission(const Surface& s, vec3 to_view, float weight, GatherRay& to) const {
    to.lamps[size_t(s.light)] += to.throughput * emitters_.radiance(s, to_view) * weight;
}

/// Adds the direct light of lamps that a surface reflects along the ray.
void Gatherer::add_lamps(const Seen& at, LampChoice choice, GatherRay& to) const {
    const Surface& s = at.surface;
    for (uint lamp = 0; lamp < scene_.lights.size(); ++lamp) {
        if (has_surface(scene_.lights[lamp].type) && choice == LampChoice::without_meshes) continue;
        const float u = to.rng.next(), v = to.rng.next();
        const std::optional<Incident> in = emitters_.arrive(lamp, s.position, u, v);
        if (!in || dot(in->to_light, at.n_geometric) <= 0 || dot(in->to_light, at.n_shading) <= 0) continue;
        const vec3 f = to.throughput * surfaces_.eval_brdf(s, at.n_shading, at.to_view, in->to_light, false) *
                       dot(in->to_light, at.n_shading);
        if (f.x + f.y + f.z <= 0) continue;
        const vec3 light =
            f * in->radiance * caster_.transmittance(caster_.offset(s.position, at.n_geometric), in->position);
        float weight = in->pdf > 0 ? 1 / in->pdf : 1.0f;
        if (has_surface(scene_.lights[lamp].type) && choice == LampChoice::with_path)
            weight *= share_of(in->pdf, bsdf_pdf(surfaces_, s, at.to_view, in->to_light));
        to.lamps[lamp] += light * weight;
    }
}

/// Adds the reflected light of the photons of a grid within `radius` m. `covered`: the coverage of the kernel;
/// with_meshes = false leaves out the photons of mesh lamps.
void Gatherer::add_photons(const SurfaceGrid& grid, float radius, float covered, const Seen& at, bool with_meshes,
                           GatherRay& to) const {
    const float r2 = radius * radius, peak = kernel_peak(r2) * (1 / map_.flux_scale) / covered;
    Surface s = at.surface;
    s.roughness = std::max(s.roughness, min_reflected_roughness);
    const vec3 diffuse = surfaces_.eval_brdf(s, at.n_shading, at.to_view, at.n_shading, true);
    maps_.visit_photons(grid, position_in_grid(grid, s.position), radius, [&](uint i, PhotonPlace place, float d2) {
        const uint lamp = light_of(place);
        if (!with_meshes && has_surface(scene_.lights[lamp].type)) return;
        vec3 f = diffuse;
        if (map_.has_directions()) {
            const vec3 from = unpack_direction(map_.directions[i]);
            const float tilt = clamp(dot(at.n_shading, from) / std::max(dot(at.n_geometric, from), 0.05f), 0.0f, 2.0f);
            f = surfaces_.eval_brdf(s, at.n_shading, at.to_view, from, false) * tilt;
        }
        const vec3 light = to.throughput * f * unpack_rgb9e5(map_.fluxes[i]) * (peak * kernel_shape(d2 / r2));
        to.lamps[lamp] += light;
        to.shares.add(i, file_lux(lamp, light));
    });
}

/// Adds the reflected light of the photons within half the search radius. A radius that does not depend on the photons
/// keeps their sum unbiased, and rays average the noise at single points.
void Gatherer::add_reflected(const Seen& at, GatherRay& to) const {
    if (at.at.index == no_grid) return;
    const float radius = 0.5f * at.at.grid.radius;
    add_photons(at.at.grid, radius, maps_.covered_part(at.at, radius), at, true, to);
}

/// Adds the reflected light of caustics, which are far sharper: from their own grids, with the bandwidth of a picture.
/// with_meshes = false leaves out mesh lamps, which the path finds itself when it goes on.
void Gatherer::add_caustics(const Seen& at, bool with_meshes, GatherRay& to) const {
    const uint own = map_.caustic_grids > 0
                         ? maps_.behind_cuts(maps_.caustic_grid_of(at.triangle, at.front), at.surface.position)
                         : no_grid;
    if (own == no_grid) return;
    const SurfaceGrid& grid = maps_.grid_at(own);
    const float radius = maps_.caustic_radius(grid, position_in_grid(grid, at.surface.position));
    add_photons(grid, radius, maps_.caustic_coverage(at.at, grid, radius), at, with_meshes, to);
}

/// True when the photons around a point may be used: the coverage is not small (dividing by a small one is biased
/// upwards), and nothing stands on the surface within the kernel, under which light would leak.
bool Gatherer::is_resolved(const Seen& seen) const {
    constexpr int feelers = 6;
    constexpr float reach = 1.2f;  // over cos 30 degrees, so that a wall between two feelers is met
    if (seen.at.index == no_grid) return true;
    const float radius = 0.5f * seen.at.grid.radius;
    if (maps_.covered_part(seen.at, radius) < min_used_coverage) return false;
    const mat3 frame = frame_around(seen.n_geometric);
    const vec3 start = caster_.offset(seen.surface.position, seen.n_geometric);
    for (int i = 0; i < feelers; ++i)
        if (caster_.nearest(start, frame * direction_of(0, float(i) / feelers), reach * radius)) return false;
    return true;
}

/// True when a point is so near that it sees how photons are spread.
bool Gatherer::is_close(const Seen& seen, float distance) const {
    return seen.at.index != no_grid && distance < 0.5f * seen.at.grid.radius;
}

/// The surface of a hit, for a ray that comes from unit direction `to_view`.
auto Gatherer::seen_from(vec3 to_view, const Hit& hit, const Surface& s) const -> Seen {
    const bool front = dot(s.geometric_normal, to_view) >= 0;
    const vec3 n_geometric = front ? s.geometric_normal : -s.geometric_normal, n = front ? s.normal : -s.normal;
    const MapReader::GridPlace at = maps_.place_on_grid(maps_.grid_of(hit.triangle, front), s.position);
    return {hit.triangle, s, at, to_view, n_geometric, dot(n, to_view) > 1e-4f ? n : n_geometric, front};
}

/// The path goes on through glass, at mirrors, and at surfaces too close or too small for the photons around to be
/// used, as corners and furniture would come out too bright or too dark.
void Gatherer::gather(vec3 origin, vec3 direction, GatherRay& to) const {
    // Direct light of the sensor is already counted, but not light by a mirror or lens. After a surface from which the
    // path went on, lamps are found by samples and by the path.
    bool emission = false;
    vec3 medium(0);                    // absorption of the medium that the ray is in, 1/m
    float density = 0, travelled = 0;  // pdf of the last direction, 0 after a mirror; m travelled since
    for (int depth = 0; depth < max_path; ++depth) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction);
        if (!hit) return;
        const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
        if (s.flags & material_unlit) return;
        const vec3 to_view = -direction;
        travelled += hit->distance;
        to.throughput *= surfaces_.passed_by_medium(absorption_before(surfaces_, s, direction, medium), hit->distance);
        if (emission && s.light >= 0) {
            const float other = density > 0 ? emitters_.arrive_pdf(s, travelled, direction) : 0.0f;
            add_emission(s, to_view, density > 0 ? share_of(density, other) : 1.0f, to);
        }
        Seen at = seen_from(to_view, *hit, s);
        const bool specular = surfaces_.is_purely_specular(s);
        const bool sharp = !specular && s.metallic > 0.5f && s.roughness < min_gathered_roughness;
        const bool close = is_close(at, hit->distance) || !is_resolved(at);
        const bool walk_on = specular || sharp || close;
        if (!walk_on) {
            add_reflected(at, to);
            if (at.at.index != no_grid) to.spread = at.at.grid.radius / hit->distance;
            at.surface.roughness = std::max(s.roughness, min_direct_roughness);
        }
        if (!specular && (walk_on || !map_.settings.direct_in_photons))
            add_lamps(at, sharp ? LampChoice::without_meshes : walk_on ? LampChoice::with_path : LampChoice::all, to);
        if (!specular) add_caustics(at, !walk_on, to);
        if (!walk_on && s.transmission <= 0) return;

        const std::optional<Scatter> next = sample_bsdf(surfaces_, s, to_view, Carries::radiance, to.rng);
        if (!next) return;
        const bool passes = dot(next->direction, at.n_geometric) < 0;
        if (!walk_on && !passes) return;
        to.throughput *= next->weight;
        if (depth > 3) {
            const float survival =
                std::min(0.95f, std::max({to.throughput.x, to.throughput.y, to.throughput.z}) / lw_pi);
            if (!(to.rng.next() < survival)) return;
            to.throughput /= survival;
        }
        if (!next->straight) emission = true, density = next->specular || sharp ? 0.0f : next->pdf, travelled = 0;
        direction = next->direction;
        medium = absorption_after(surfaces_, s, direction, medium);
        origin = caster_.offset(s.position, passes ? -at.n_geometric : at.n_geometric);
    }
}

}  // namespace lw
