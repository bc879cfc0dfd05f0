// Collisions of a walker: capsules against the triangles of a scene, and rays for the floor.
#pragma once
#include <optional>

#include "trace/box_search.h"
#include "trace/ray_caster.h"

namespace lw {

/// An upright capsule: all points within `radius` m of the segment from `low` to `low` + (0, length, 0).
struct Capsule {
    vec3 low;
    float length;
    float radius;
};

/// Scene and caster must outlive it. Thread-safe for queries.
class CollisionMesh {
  public:
    CollisionMesh(const Scene& scene, const RayCaster& caster);

    /// True when no surface crosses the segment.
    bool is_free(vec3 from, vec3 to) const;
    /// Height (Y) of the first surface below a point, if any.
    std::optional<float> floor_below(vec3 point) const;
    /// How deep the nearest surface reaches into the capsule, m; 0 when it is free.
    float overlap(const Capsule& capsule) const;
    /// A horizontal move, m, that frees the capsule: a few steps, each away from the surface that reaches deepest. It
    /// may not free it in narrow places.
    vec3 push_out(const Capsule& capsule) const;
    const RayCaster& caster() const { return caster_; }

  private:
    /// Vector from the nearest surface point to the capsule's axis, and how deep that point lies in the capsule, m.
    struct Contact {
        vec3 away{0};
        float depth = 0;
    };
    Contact max_contact(const Capsule& capsule) const;

    const Scene& scene_;
    const RayCaster& caster_;
    BoxSearch triangles_;
};

}  // namespace lw
