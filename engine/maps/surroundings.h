// How far away the surroundings of surfaces are: what the sizes of patches, lattices and kernels follow, wherever in a
// scene they lie.
#pragma once
#include <array>
#include <span>

#include "trace/ray_caster.h"

namespace lw {

/// A point of a surface from which rays look around.
struct LookOut {
    vec3 position, normal;
    float lift;  // m, how far above the surface its rays start
};

/// What the rays from some points found.
struct Surroundings {
    float distance;  // m, the harmonic mean of what was met; 1e30 where nothing was
    float missed;    // the part of the rays that met nothing
    float spread;    // how many times nearer they are at some points than at others, without the extremes
};

/// Sends `rays` from each point, in the directions from which it is lit, that is by the cosine. Points covered by what
/// lies on the surface hardly count. `seed` should follow from the place, so that the rest of the scene changes
/// nothing.
Surroundings look_around(const RayCaster& caster, std::span<const LookOut> points, uint rays, uint64_t seed);

/// How far above a triangle rays must start, m.
float lift_above(const std::array<vec3, 3>& corners);

/// A number that follows from places in the world, to a millimetre: the rest of a scene may move its origin, and with
/// it the last bits of all coordinates.
uint64_t seed_of(const glm::dvec3& origin, std::span<const vec3> places);

/// The scales of patches: powers of two, so that most neighbours have the same, and rays that differ by chance give the
/// same.
class ScaleRule {
  public:
    /// Between 1/8 m and 16 m; less in the scene of a thing smaller than a room, more in one wider than a town.
    explicit ScaleRule(const Scene& scene);
    float least() const { return least_; }
    /// From the distance of the surroundings, m.
    float scale_of(float distance) const;
    /// The scale of a patch, but not too large for its width, m.
    float at_most(float scale, float width) const;

  private:
    float least_, largest_;
};

}  // namespace lw
