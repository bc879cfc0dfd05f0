// Light that reaches surfaces from lamps and the sun by way of mirrors, polished metal and glass alone. Paths from the
// eye find it rarely or never, so it is traced from the lamps and estimated with a small kernel. The mean over many
// independent sets with shrinking radii converges to the truth (memoryless progressive photon mapping, Knaus & Zwicker
// 2011). Used by the reference path tracer, not by the maps.
#pragma once
#include <span>
#include <vector>

#include "trace/emitter.h"
#include "trace/ray_caster.h"
#include "trace/sky_sampler.h"

namespace lw {

/// How one set of caustic paths is traced.
struct CausticSettings {
    uint64_t paths = 200'000;  // of all lamps and the sun together
    float radius = 0;          // m, of the kernel
    uint64_t seed = 1;
    uint64_t set = 0;                 // number of the set; sets of different numbers are independent
    const SkySampler* sky = nullptr;  // whose sun shines too
};

/// True for a surface whose only lobes are so narrow that light sampling hardly finds a lamp through them. Light by way
/// of such surfaces is traced from the lamps.
bool casts_caustics(const Surface& s);

/// True when a lamp or the sun of `sky` has power and a material is, or by its textures may be, a mirror, smooth glass,
/// or polished metal or glass. `powers`: RGB power of each lamp.
bool has_caustics(const Scene& scene, std::span<const vec3> powers, const SkySampler* sky = nullptr);

/// One set of caustic light: the arrivals at surfaces that cast no caustics, of paths that met only such as do.
class Caustics {
  public:
    /// Traces a set; the result does not depend on the number of threads.
    Caustics(const Scene& scene, const RayCaster& caster, std::span<const vec3> powers,
             const CausticSettings& settings);

    /// Irradiance at `point` on the side of unit `normal`, lux per RGB.
    vec3 irradiance(vec3 point, vec3 normal) const;

    /// Radiance that the caustic light at `s` sends towards `to_view`, cd/m2; n and ng are turned to the viewer.
    vec3 reflected(const SurfaceReader& reader, const Surface& s, vec3 n, vec3 ng, vec3 to_view) const;

    /// The arrivals, one record each, for tests that count them.
    struct Arrival {
        vec3 position;
        vec3 flux;    // lm
        vec3 from;    // unit
        vec3 normal;  // geometric, unit, on the lit side
    };
    const std::vector<Arrival>& arrivals() const { return arrivals_; }

  private:
    template <class Visit>
    void visit_near(vec3 point, vec3 normal, const Visit& visit) const;
    uint cell_of(vec3 position) const;

    std::vector<Arrival> arrivals_;  // sorted by cell
    std::vector<uint> cell_starts_;  // of each cell of a hash table; the cells are cubes 2 radius_ wide
    float radius_ = 0;
};

}  // namespace lw
