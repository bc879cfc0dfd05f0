// The reference: unbiased radiance and illuminance by path tracing with light sampling and multiple importance sampling
// (Veach 1997), from the same scene, lamps and BSDF as the photons, but none of their estimators. Light that comes from
// lamps and the sun by way of mirrors and lenses is hardly found by paths from the eye; trace/caustics adds it. Sky and
// ground are seen by all rays that leave the scene.
#pragma once
#include <vector>

#include "base/random.h"
#include "trace/caustics.h"
#include "trace/emitter.h"
#include "trace/ray_caster.h"
#include "trace/sky_sampler.h"

namespace lw {

class PathTracer {
  public:
    /// `powers`: RGB power of each lamp (lamp_powers()). `sky`: nullptr for a scene without daylight. All that is
    /// referred to must outlive the tracer.
    PathTracer(const Scene& scene, const RayCaster& caster, std::vector<vec3> powers, const SkySampler* sky = nullptr);

    /// One sample of the radiance that arrives at `origin` from unit `direction`, cd/m2 per RGB. Unbiased except for
    /// caustics: without `caustics` those of points and suns are missing; with a set, all are blurred over its radius.
    /// A set must have been traced with the sky of this tracer.
    vec3 radiance(vec3 origin, vec3 direction, Rng& rng, const Caustics* caustics = nullptr) const;

    /// One sample of the irradiance at `point` on the side of unit `normal`, lux per RGB; caustics as above.
    vec3 irradiance(vec3 point, vec3 normal, Rng& rng, const Caustics* caustics = nullptr) const;

  private:
    struct Vertex;
    vec3 direct(const Vertex& at, bool all_lamps, Rng& rng) const;
    vec3 direct_from(uint light, const Vertex& at, Rng& rng) const;
    vec3 daylight(const Vertex& at, bool with_sun, Rng& rng) const;
    vec3 reflected(const Vertex& at, const Incident& in, bool path_may_meet_it) const;
    vec3 follow(vec3 origin, vec3 direction, float bsdf_pdf, bool first, const Caustics* caustics, Rng& rng) const;

    const Scene& scene_;
    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::vector<vec3> powers_;
    const SkySampler* sky_;
};

}  // namespace lw
