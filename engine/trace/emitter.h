// Sampling of the lights of a scene on the CPU: emission of photons, and light that arrives at a point. The light that
// arrives has the text of shaders/lights.glsl, which the GPU runs too; only places on mesh lamps are computed anew
// here. Everything is for intensity 1 of the lamp (1 cd, 1 lx or 1 cd/m2 of each RGB channel); the caller multiplies by
// the power of the lamp. A lamp is named by its index in Scene::lights, and all numbers that pick samples lie in [0,
// 1).
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "scene/light.h"

namespace lw {

/// A photon leaving its lamp.
struct Emission {
    vec3 origin;     // m
    vec3 normal;     // unit, of the emitting side of the surface; zero for lamps without a surface
    vec3 direction;  // unit
    vec3 flux;       // lm per unit intensity, RGB, if this were the only photon; divided by how many are emitted
};

/// Light arriving at a point from one sampled place of a lamp, if nothing stands between.
struct Incident {
    vec3 to_light;  // unit
    vec3 position;  // m, on the lamp; of directional light far outside the scene
    vec3 radiance;  // per unit intensity: cd/m2; of delta lights lx on a plane facing the light
    float pdf;      // of to_light, per sr; 0 for delta lights
};

/// Reads the lamps of a Scene; the Scene must outlive it. Thread-safe.
class Emitters {
  public:
    explicit Emitters(const Scene& scene);

    /// Flux of the whole lamp, lm per unit intensity; see scene/light.h.
    float unit_flux(uint light) const;

    /// Samples emission. u[0] and u[1] pick the place on the lamp, u[2] and u[3] the direction, u[4] the side of a
    /// sheet that glows on both.
    Emission emit(uint light, const std::array<float, 5>& u) const;

    /// Samples light arriving at `point` (m). u and v pick the place on a mesh lamp. Returns nullopt when no light
    /// comes from the place, as from behind a sheet that glows on one side.
    std::optional<Incident> arrive(uint light, vec3 point, float u, float v) const;

    /// Radiance that a surface emits towards unit `to_view`, cd/m2 per unit intensity of its lamp; zero without a lamp.
    vec3 radiance(const Surface& s, vec3 to_view) const;

    /// The pdf, per sr, with which arrive() picks the point `s` of a mesh lamp, seen at `distance` (m) in unit
    /// direction `to_light`.
    float arrive_pdf(const Surface& s, float distance, vec3 to_light) const;

    /// True for a mesh of at most eight triangles that shines alike all over: even_irradiance() holds for it.
    bool is_even(uint light) const;
    /// Irradiance at `point` on a plane facing unit `normal` from all of a lamp that is_even(), lx per unit intensity,
    /// if nothing stands between: the vector irradiance of its triangles above the plane (Lambert 1760; Arvo 1995,
    /// equation 3.5).
    vec3 even_irradiance(uint light, vec3 point, vec3 normal) const;

  private:
    Emission emit_profile(const Light& light, const ProfileCells& cells, float u, float v) const;
    Emission emit_from_mesh(const Light& light, const std::array<float, 5>& u) const;

    const Scene& scene_;
    LightReader reader_;
    std::vector<ProfileCells> profiles_;  // per lamp, empty where the lamp has no table
    /// The point of a mesh lamp that u and v pick, uniform by area.
    Surface point_of(const Light& light, float u, float v) const;
    /// What surface_at() returns, but only its place and what it emits: all that a lamp that shines alike needs.
    Surface even_point(uint triangle, vec2 barycentrics) const;

    /// The radiance of a mesh lamp that shines alike all over, per unit intensity; negative of any other.
    vec3 even_radiance_of(const Light& light) const;
    std::vector<vec3> even_radiance_;  // per lamp: even_radiance_of()
    bool shines_alike(size_t light) const { return even_radiance_[light].x >= 0; }

    vec3 centre_;   // of the sphere around the scene, m
    float radius_;  // of that sphere, m
};

/// RGB power of each lamp of the scene, in the unit of its intensity: intensity x factor, per channel. `factors`: one
/// per lamp; those that are missing at the end are 1.
std::vector<vec3> lamp_powers(const Scene& scene, const std::vector<vec3>& factors);

}  // namespace lw
