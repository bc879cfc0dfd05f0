// Samples of surfaces, from which the coverage of kernels is counted where it has no closed form.
#pragma once
#include <vector>

#include "maps/partition.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// The neighbourhoods of some points, as cells of space. Says yes to a few places beyond them.
class Neighbourhoods {
  public:
    /// `radius` of them all, m.
    explicit Neighbourhoods(float radius) : radius_(radius), bits_(size_t(1) << 16) {}
    void add(vec3 point);
    bool contain(vec3 point) const;

  private:
    static constexpr uint64_t bit_count = 64ull << 16;
    uint64_t bit_of(vec3 cell) const;

    float radius_;
    std::vector<uint64_t> bits_;  // one per cell, by its hash
};

/// What the samples of surfaces are for.
struct WantedSamples {
    const Partition& partition;
    std::vector<char> is_wanted;    // of each patch: whether it has nodes that need samples
    Neighbourhoods neighbourhoods;  // of these nodes

    /// False only when a sample there belongs to no patch that needs any.
    bool contain(size_t side, vec3 position) const;
    /// For each side of the triangles: false when contain() is, everywhere on it.
    std::vector<char> sides() const;
};

struct SampleSettings {
    float area;       // m2 that a sample stands for
    float clearance;  // m
};

/// Evenly spread points on the sides of triangles, those that are wanted and without those that lie closer than
/// the clearance under another surface all around: no light gets there. As photons whose flux is their area, or as
/// little as gives a small patch its share.
std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted,
                                    SampleSettings settings);

}  // namespace lw
