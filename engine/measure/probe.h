// A light meter for a point of a surface: illuminance with the share of each lamp, and a 90 % interval from the same
// photons. More accurate and slower than a pixel: direct light of all lamps by many rays, reflected light by the smooth
// estimate at two bandwidths, whose difference measures the bias.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "maps/photon_map.h"
#include "scene/bvh.h"
#include "trace/ray_caster.h"

namespace lw {

struct LampShare {
    float lux = 0;
    float direct_lux = 0;  // the part of lux that comes straight from the lamp
};

struct Measurement {
    vec3 position{0};  // m, relative to the scene's origin
    vec3 normal{0};    // geometric, turned to the viewer
    uint triangle = 0;
    float lux = 0;
    float half_width_lux = 0;  // of the 90 % interval
    float luminance = 0;       // cd/m2 towards the viewer
    float photons = 0;         // under the kernel
    float bandwidth = 0;       // m
    std::vector<LampShare> lamps;
};

/// The first surface that a view ray along unit `direction` meets. Glass and holes are looked through, as in the
/// picture.
std::optional<Hit> seen_from(const Scene& scene, const RayCaster& caster, vec3 origin, vec3 direction);

/// A point of a surface, and the place of the viewer, m.
struct SeenPlace {
    Hit hit;
    vec3 viewer;
};

/// The probe for one scene and map. It is made once and measures at any powers of the lamps. Thread-safe.
class Probe {
  public:
    /// All four arguments must outlive it. Finds which lamps each cell of the map sees, which takes about as long as
    /// some measurements.
    Probe(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const Bvh& bvh);
    ~Probe();

    /// Measures at the point of the hit, on the side of its viewer. `powers`: RGB power of each lamp (lamp_powers()).
    Measurement measure(const std::vector<vec3>& powers, const SeenPlace& place) const;
    /// The same for many places at once.
    std::vector<Measurement> measure(const std::vector<vec3>& powers, std::span<const SeenPlace> places) const;

    struct Parts;  // data that all measurements share

  private:
    std::unique_ptr<const Parts> parts_;
};

}  // namespace lw
