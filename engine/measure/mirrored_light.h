// The light of lamps that a view ray shows by reflections at mirrors and glossy surfaces, told apart by lamp and by the
// first surface that reflects.
#pragma once
#include <map>
#include <span>
#include <utility>

#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

/// Luminance in cd/m2 for each (lamp, object of the first reflecting surface).
using MirroredLight = std::map<std::pair<uint, uint>, double>;

/// Follows view rays. All references must outlive it. Thread-safe.
class MirrorTracer {
  public:
    MirrorTracer(const Scene& scene, const RayCaster& caster, std::span<const vec3> powers)
        : scene_(scene), caster_(caster), surfaces_(scene), emitters_(scene), powers_(powers) {}

    /// Traces a view ray and adds `share` times the mirrored light of what it meets: of every sheet of thin glass on
    /// its way and of the first other surface.
    void add(vec3 origin, vec3 direction, double share, Rng& rng, MirroredLight& light) const;

  private:
    void reflect(const Surface& first, uint object, vec3 to_view, vec3 part, Rng& rng, MirroredLight& light) const;
    void add_lamps(const Surface& s, vec3 n, vec3 to_view, vec3 part, uint object, Rng& rng,
                   MirroredLight& light) const;

    const Scene& scene_;
    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::span<const vec3> powers_;
};

}  // namespace lw
