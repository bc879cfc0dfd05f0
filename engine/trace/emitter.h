// Light leaving the lamps: emission for photons, and light sampling for the path tracer.
// Everything is for intensity 1 of the lamp (1 cd, 1 lx, 1 cd/m2 per RGB channel); powers are applied by the caller.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "scene/surface.h"

namespace lw {

/// A photon leaving its lamp.
struct Emission {
    vec3 origin;
    vec3 normal;     // of the emitting surface, zero for points and the sun
    vec3 direction;  // unit
    vec3 flux;       // lm per unit intensity, per RGB, if this were the only photon
};

/// Light arriving at a point from one sampled place of a lamp, unoccluded.
struct Incident {
    vec3 to_light;  // unit
    vec3 position;  // on the lamp, or far outside the scene for directional light
    vec3 radiance;  // delta lights: irradiance on a plane facing the light; mesh lights: radiance, per unit intensity
    float pdf;      // solid angle; 0 for delta lights
};

/// Reads the lamps of a Scene; the Scene must outlive it. Thread-safe.
class Emitters {
  public:
    explicit Emitters(const Scene& scene);

    /// Flux of the whole lamp, lm per unit intensity (directional: over the disc around the scene).
    /// Point: 4 pi; spot: 2 pi ((1 - cos_i) + (cos_i - cos_o) / 3), the integral of the squared KHR falloff; mesh: pi
    /// A.
    float unit_flux(uint light) const;

    /// Samples emission from five numbers in [0, 1): position (2), direction (2), side of the sheet (1).
    Emission emit(uint light, const std::array<float, 5>& u) const;

    /// Samples light arriving at `point` from two numbers; nullopt when the lamp cannot light it.
    std::optional<Incident> arrive(uint light, vec3 point, float u, float v) const;

    /// Emitted radiance at a surface towards `to_view`, per unit intensity of its lamp; zero without a lamp.
    vec3 radiance(const Surface& s, vec3 to_view) const;

    /// Solid-angle pdf with which arrive() picks the point of a mesh lamp at this distance and direction.
    float arrive_pdf(const Surface& s, float distance, vec3 to_light) const;

    /// True for a mesh of few triangles that shines alike all over: its light has a closed form.
    bool is_even(uint light) const;
    /// Irradiance at `point` on a plane facing unit `normal` from all of a lamp that is_even(), unoccluded, per unit
    /// intensity: the vector irradiance of its triangles above the plane (Lambert 1760; Arvo 1995, equation 3.5).
    vec3 even_irradiance(uint light, vec3 point, vec3 normal) const;

  private:
    /// Cells of a light distribution, picked in proportion to their flux; their last sum is the lamp's, lm per cd.
    struct Beam {
        uint columns = 0, rows = 0;
        std::vector<float> flux_below;
    };
    Beam beam_of(const Light& light) const;
    Emission emit_profile(const Light& light, const Beam& beam, float u, float v) const;

    const Scene& scene_;
    SurfaceReader surfaces_;
    std::map<uint, Beam> beams_;  // by the first word of the table of a profile light
    /// The point at (u, v) of a mesh lamp, uniform by area.
    Surface point_of(uint light, float u, float v) const;
    Surface even_point(uint triangle, vec2 barycentrics) const;
    float area_of(const Light& light) const;  // one side, m2

    vec3 even_radiance_of(const Light& light) const;
    std::vector<vec3> even_radiance_;  // per lamp, per unit intensity; negative where it does not shine alike all over
    bool shines_alike(uint light) const { return even_radiance_[light].x >= 0; }

    vec3 centre_;
    float radius_;  // of the sphere around the scene
};

/// RGB power of each lamp: intensity x factor, per channel. `factors` empty means all 1.
std::vector<vec3> light_powers(const Scene& scene, const std::vector<vec3>& factors);

}  // namespace lw
