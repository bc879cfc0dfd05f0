// The reference: unbiased radiance and illuminance by path tracing with light sampling and multiple importance
// sampling (Veach 1997), from the same scene, lamps and BRDF as the photons, but none of their estimators.
#pragma once
#include <vector>

#include "base/random.h"
#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

class PathTracer {
  public:
    /// `weights`: RGB power of each lamp (light_weights()). All references must outlive the tracer.
    PathTracer(const Scene& scene, const RayCaster& caster, std::vector<vec3> weights);

    /// One unbiased sample of the radiance arriving at `origin` from `direction`, cd/m2 per RGB.
    vec3 radiance(vec3 origin, vec3 direction, Rng& rng) const;

    /// One unbiased sample of the irradiance at `point` on the side of unit `normal`, lux per RGB.
    vec3 irradiance(vec3 point, vec3 normal, Rng& rng) const;

  private:
    vec3 direct(const Surface& s, vec3 n, vec3 ng, vec3 to_view, bool all_lamps, Rng& rng) const;
    vec3 direct_from(uint light, const Surface& s, vec3 n, vec3 ng, vec3 to_view, Rng& rng) const;
    vec3 follow(vec3 origin, vec3 direction, float bsdf_pdf, bool first, Rng& rng) const;

    const Scene& scene_;
    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::vector<vec3> weights_;
};

}  // namespace lw
