// Nearest hit and visibility against the triangles of a Scene; with build_bvh the only user of Embree.
#pragma once
#include <optional>
#include <vector>

#include "base/random.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lw {

struct Hit {
    uint triangle;
    vec2 barycentrics;  // weights of the second and third vertex
    float distance;     // m along the unit direction
};

/// Owns the Embree scene. Thread-safe for queries. The Scene must outlive it.
class RayCaster {
  public:
    /// Throws Error when Embree cannot build (out of memory).
    explicit RayCaster(const Scene& scene);
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// Nearest surface along a unit direction. Holes of alpha masks are passed. A blended surface (alpha < 1) is met or
    /// passed by a hash of the place, in proportion to alpha: the same ray always gives the same answer.
    std::optional<Hit> nearest(vec3 origin, vec3 direction, float max_distance = 1e30f) const;

    /// The same for random paths: a blended surface is met with the probability of its alpha. Hits of blended surfaces
    /// that were passed are appended to `passed`, if given: photons light them too.
    std::optional<Hit> nearest(vec3 origin, vec3 direction, Rng& rng, std::vector<Hit>* passed = nullptr) const;

    /// Fraction of light, per RGB, that passes between two points by the rule of passed_by() in shaders/bsdf.glsl: 0
    /// when something opaque stands between, else the product of the tints of thin smooth glass and of 1 - alpha of
    /// blended surfaces.
    vec3 transmittance(vec3 from, vec3 to) const;

    /// Writes the indices of all triangles within `radius` m of a point to `found`. Returns false when there are more
    /// than `most`; then `found` holds only that many.
    bool triangles_around(vec3 point, float radius, size_t most, std::vector<uint>& found) const;

    /// `point` moved off its surface along `normal` by a few units of float precision of the scene.
    vec3 offset(vec3 point, vec3 normal) const { return point + normal * epsilon_; }
    float epsilon() const { return epsilon_; }

  private:
    std::optional<Hit> nearest_triangle(vec3 origin, vec3 direction, float max_distance) const;
    float opacity(const Hit& hit) const;
    template <class Choose>
    std::optional<Hit> nearest_chosen(vec3 origin, vec3 direction, float max_distance, const Choose& number,
                                      std::vector<Hit>* passed_hits = nullptr) const;

    const Scene& scene_;
    SurfaceReader surfaces_;
    void* device_ = nullptr;
    void* embree_scene_ = nullptr;
    float epsilon_ = 0;
    bool has_holes_ = false;       // alpha masks or blends
    bool has_thin_glass_ = false;  // which shadow rays may pass
};

}  // namespace lw
