// Sampling of the daylight around a scene: the sky and the ground by luminance, the sun by its disc. Directions over
// all the sphere are cells of equal solid angle, of which one is picked by its mean luminance.
#pragma once
#include <optional>
#include <vector>

#include "daylight/daylight.h"
#include "trace/emitter.h"

namespace lw {

/// The Daylight must outlive it. Thread-safe.
class SkySampler {
  public:
    SkySampler(const Scene& scene, const Daylight& light);

    /// Samples light of sky and ground that arrives at `point`, m. `u` picks the cell and the direction in it, each
    /// number in [0, 1).
    Incident arrive(vec3 point, vec3 u) const;

    bool has_sun() const { return luminance_of_sun_ > 0; }
    /// Samples light of the sun that arrives at `point`, uniform over its disc. Only with has_sun().
    Incident arrive_from_sun(vec3 point, float u, float v) const;

    /// A photon of the sun, its flux that of all sunlight through a sphere around the scene. `u` picks place and
    /// direction, each number in [0, 1).
    Emission emit_from_sun(const std::array<float, 5>& u) const;

    /// cd/m2 from the unit direction of a path that left the scene, weighted against the samples above. `path_pdf`: per
    /// sr, the density with which the path took the direction; 0 when no samples were taken at its last vertex.
    /// Without `with_sun` the sun's disc is left out.
    vec3 radiance(vec3 direction, float path_pdf, bool with_sun = true) const;

    /// Density per sr with which arrive() picks a direction.
    float pdf(vec3 direction) const;

  private:
    Incident incident(vec3 point, vec3 direction, vec3 radiance, float pdf) const;
    vec3 direction_to_sun(float u, float v) const;

    const Daylight& daylight_;
    vec3 centre_;   // of the scene, m
    float radius_;  // of a sphere around it, m
    float luminance_of_sun_;
    std::vector<float> ends_;  // per cell: the share of the light in it and all before it
};

/// A sampler when there is daylight.
std::optional<SkySampler> sky_around(const Scene& scene, const Daylight* light);

}  // namespace lw
