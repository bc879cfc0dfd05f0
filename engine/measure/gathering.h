// What a ray from a sensor brings back: followed to the first surface that photons can describe, where the photons of
// the map and the direct light of the lamps say what each lamp sends on (final gathering; Jensen 2001, section 8.3.2).
#pragma once
#include <vector>

#include "maps/map_reader.h"
#include "measure/reading.h"
#include "scene/surface.h"
#include "shaders/color.h"
#include "trace/emitter.h"
#include "trace/ray_caster.h"

namespace lw {

/// What each photon brings to the sensor at hand, at the file's powers: the spread of the whole sum.
struct PhotonShares {
    explicit PhotonShares(size_t references) : lux(references, vec3(0)) {}
    void add(uint reference, ChannelLux value);
    void clear();
    std::vector<ChannelLux> lux;
    std::vector<uint> touched;
};

/// A ray to the surroundings and what it brought so far.
struct GatherRay {
    vec3 throughput;           // lux per radiance and RGB
    std::vector<vec3>& lamps;  // lx per unit intensity and RGB
    PhotonShares& shares;
    Rng& rng;
};

/// Which lamps light a surface around by their own samples: all; all but meshes, which its next ray finds; all, but
/// meshes together with the next ray (multiple importance sampling, Veach 1997).
enum class LampChoice { all, without_meshes, with_path };

/// Gathers in one scene and map. Thread-safe. All references must outlive it.
class Gatherer {
  public:
    Gatherer(const Scene& scene, const RayCaster& caster, const PhotonMap& map)
        : scene_(scene), caster_(caster), map_(map), surfaces_(scene), maps_(map), emitters_(scene) {}

    const SurfaceReader& surfaces() const { return surfaces_; }
    const MapReader& maps() const { return maps_; }
    const Emitters& emitters() const { return emitters_; }

    /// Follows a ray and adds what it brings.
    void gather(vec3 origin, vec3 direction, GatherRay& to) const;

    /// Light of one lamp per unit intensity and RGB as lux of its power in the file.
    ChannelLux file_lux(uint lamp, vec3 per_intensity) const {
        return per_intensity * scene_.lights[lamp].intensity * luminance_weights;
    }

  private:
    /// A surface as a ray meets it.
    struct Seen {
        uint triangle;
        Surface surface;
        MapReader::MapPlace at;
        vec3 to_view;
        vec3 n_geometric;  // both turned to the ray's origin
        vec3 n_shading;
        bool front;
    };

    Seen seen_from(vec3 to_view, const Hit& hit, const Surface& s) const;
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
