// Light of lamps by way of mirrors, polished metal and glass alone: what paths from the eye find not at all, or rarely.
// Traced from the lamps and spread over a small radius; the mean over many independent sets with shrinking radii
// converges to the truth (progressive photon mapping in its memoryless form, Knaus & Zwicker 2011). Used by the
// reference, not by the maps.
#pragma once
#include <span>
#include <vector>

#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

/// How one set of caustic light is traced.
struct CausticSettings {
    uint64_t paths = 200'000;  // from all such lamps together
    float radius = 0;          // m, over which it is spread
    uint64_t seed = 1;
    uint64_t set = 0;  // another set is independent of this one
};

/// True for a surface of nothing but lobes so narrow that light sampling hardly finds them: light by way of it is
/// traced from the lamps.
bool casts_caustics(const Surface& s);

/// True when the scene has a lamp of weight > 0 and a mirror, smooth glass or gloss that is
/// followed as a mirror, or a metal or glass that casts caustics.
bool has_caustics(const Scene& scene, std::span<const vec3> powers);

/// Light that arrived from lamps by specular bounces and such surfaces only, on surfaces that cast no caustics.
class Caustics {
  public:
    /// Traces a set; the result does not depend on the number of threads.
    Caustics(const Scene& scene, const RayCaster& caster, std::span<const vec3> powers,
             const CausticSettings& settings);

    /// Irradiance at `point` on the side of unit `normal`, lux per RGB.
    vec3 irradiance(vec3 point, vec3 normal) const;

    /// Radiance that the caustic light at `s` sends towards `to_view`, cd/m2; n and ng are turned to the viewer.
    vec3 reflected(const SurfaceReader& reader, const Surface& s, vec3 n, vec3 ng, vec3 to_view) const;

    /// Arrived light, one record each: for tests, which count it.
    struct Arrival {
        vec3 position;
        vec3 flux;    // lm
        vec3 from;    // unit
        vec3 normal;  // geometric, on the lit side
    };
    const std::vector<Arrival>& arrivals() const { return arrivals_; }

  private:
    template <class Visit>
    void visit_near(vec3 point, vec3 normal, const Visit& visit) const;
    uint cell_of(vec3 position) const;

    std::vector<Arrival> arrivals_;  // sorted by cell
    std::vector<uint> cell_starts_;  // of a hash table of cubes twice the radius wide
    float radius_ = 0;
};

}  // namespace lw
