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
    Neighbourhoods() : bits_(size_t(1) << 16) {}
    void add(vec3 point, float radius);
    bool contain(vec3 point) const;

  private:
    static constexpr uint64_t bit_count = 64ull << 16;
    static uint64_t bit_of(vec3 cell, int level);

    std::vector<int> levels_;     // cells of 2^level metres are in use
    std::vector<uint64_t> bits_;  // one per cell, by its hash
};

/// What the samples of surfaces are for.
struct WantedSamples {
    const Partition& partition;
    std::vector<char> is_wanted;    // of each patch: whether it has nodes that need samples
    Neighbourhoods neighbourhoods;  // of these nodes

    /// False only when a sample there belongs to no patch that needs any.
    bool contain(uint patch, vec3 position) const;
    /// What samples on a patch must be dense enough for: the least search radius, m, of it and of those that may refer
    /// to its photons, as far as they need samples, but not much less than its own; 0 when none does.
    float least_radius(uint patch) const;
};

/// Evenly spread points on the sides of triangles, those that are wanted and without those that lie closer than
/// the clearance under another surface all around: no light gets there. As photons whose flux is their area: 0.03 of
/// the square of the least radius that they count in, or as little as gives a small patch its share.
std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted);

}  // namespace lw
