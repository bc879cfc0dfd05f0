// Samples of surfaces, from which coverage is computed where it has no closed form.
#pragma once
#include <vector>

#include "maps/partition.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// The set of places within a radius of some points, kept as hashed cells of space. contain() is true for all of them
/// and for a few places beyond.
class Neighbourhoods {
  public:
    /// `radius`: of all neighbourhoods, m.
    explicit Neighbourhoods(float radius) : radius_(radius), bits_(size_t(1) << 16) {}
    void add(vec3 point);
    bool contain(vec3 point) const;

  private:
    static constexpr uint64_t bit_count = 64ull << 16;
    uint64_t bit_of(vec3 cell) const;

    float radius_;
    std::vector<uint64_t> bits_;  // one per cell, by its hash
};

/// Which samples of surfaces are needed.
struct WantedSamples {
    const Partition& partition;
    std::vector<char> is_wanted;    // per patch: 1 when it has nodes that need samples
    Neighbourhoods neighbourhoods;  // of these nodes

    /// True when a sample at this point of a side may be needed. False only when no patch that needs samples would
    /// refer to it.
    bool contain(size_t side, vec3 position) const;
    /// For each side of each triangle: 0 when contain() is false everywhere on it.
    std::vector<char> sides() const;
};

struct SampleSettings {
    float area;       // m2 that a sample stands for, less on small patches
    float clearance;  // m
};

/// Evenly spread points on the sides of triangles, where they are wanted and not buried under another surface
/// (is_buried() with settings.clearance). They are returned as photons whose flux is the area that the point stands
/// for: settings.area, or less on small patches, so that each patch has enough points.
std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted,
                                    SampleSettings settings);

}  // namespace lw
