// Final gathering for sensors (Jensen 2001, section 8.3.2). A ray from a sensor is followed to the first surface at
// which the photons of the map can be used; they and the direct light of the lamps give the radiance that each lamp
// sends back along the ray.
#pragma once
#include <vector>

#include "maps/map_reader.h"
#include "measure/reading.h"
#include "scene/surface.h"
#include "shaders/color.h"
#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

/// The contribution of each photon to one sensor, summed over all its rays, at the powers in the file. The variance of
/// the reading by photons follows from these.
struct PhotonShares {
    explicit PhotonShares(size_t references) : lux(references, vec3(0)) {}
    void add(uint reference, ChannelLux value);
    void clear();
    std::vector<ChannelLux> lux;
    std::vector<uint> touched;
};

/// The state of a ray to the surroundings, and where its light is added.
struct GatherRay {
    vec3 throughput;           // lux of the sensor per radiance along the ray, RGB
    std::vector<vec3>& lamps;  // per lamp: lx for intensity 1, RGB
    PhotonShares& shares;
    Rng& rng;
    float spread = 0;  // search radius over distance, where photons were used
};

/// Which lamps are sampled directly at a surface. all: every lamp. without_meshes: not meshes, which the next ray of
/// the path finds. with_path: every lamp, meshes weighted against the next ray (multiple importance sampling, Veach
/// 1997).
enum class LampChoice { all, without_meshes, with_path };

/// Follows the rays of sensors in one scene and map. Thread-safe. All references must outlive it.
class Gatherer {
  public:
    Gatherer(const Scene& scene, const RayCaster& caster, const PhotonMap& map)
        : scene_(scene), caster_(caster), map_(map), surfaces_(scene), maps_(map), emitters_(scene) {}

    const SurfaceReader& surfaces() const { return surfaces_; }
    const MapReader& maps() const { return maps_; }
    const Emitters& emitters() const { return emitters_; }

    /// Follows a ray and adds its light to `to`.
    void gather(vec3 origin, vec3 direction, GatherRay& to) const;

    /// Converts light of a lamp for intensity 1, RGB, to lux at the lamp's power in the file.
    ChannelLux file_lux(uint lamp, vec3 per_intensity) const {
        return per_intensity * scene_.lights[lamp].intensity * luminance_weights;
    }

  private:
    /// A surface that a ray has met.
    struct Seen {
        uint triangle;
        Surface surface;
        MapReader::GridPlace at;
        vec3 to_view;
        vec3 n_geometric;  // both turned to the ray's origin
        vec3 n_shading;
        bool front;
    };

    Seen seen_from(vec3 to_view, const Hit& hit, const Surface& s) const;
    bool is_close(const Seen& seen, float distance) const;
    bool is_resolved(const Seen& seen) const;
    void add_emission(const Surface& s, vec3 to_view, float weight, GatherRay& to) const;
    void add_lamps(const Seen& at, LampChoice choice, GatherRay& to) const;
    void add_reflected(const Seen& at, GatherRay& to) const;
    void add_caustics(const Seen& at, bool with_meshes, GatherRay& to) const;
    void add_photons(const SurfaceGrid& grid, float radius, float covered, const Seen& at, bool with_meshes,
                     GatherRay& to) const;

    const Scene& scene_;
    const RayCaster& caster_;
    const PhotonMap& map_;
    SurfaceReader surfaces_;
    MapReader maps_;
    Emitters emitters_;
};

}  // namespace lw
