// How much of a kernel lies on surface that light can reach. Density estimates are divided by it, so that edges,
// corners and the feet of furniture neither darken nor glow (boundary bias; Jensen 2001, section 7.4).
#pragma once
#include <vector>

#include "base/random.h"
#include "maps/flat_coverage.h"
#include "maps/lattice.h"
#include "maps/neighbours.h"
#include "maps/references.h"
#include "trace/ray_caster.h"

namespace lw {

/// Surfaces closer than this under another one get no light.
inline float clearance_of(float radius) { return 0.25f * radius; }

/// True when every one of a few rays into the hemisphere meets a surface lower than `clearance` over the point.
bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng);

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
    const Patches& patches;
    const Neighbours& neighbours;
    std::vector<char> is_wanted;    // of each patch: whether it has nodes that need samples
    Neighbourhoods neighbourhoods;  // of these nodes

    /// False only when a sample there belongs to no patch that needs any.
    bool contain(size_t side, vec3 position) const;
    /// For each side of the triangles: false when contain() is, everywhere on it.
    std::vector<char> sides() const;
};

/// Evenly spread points on the sides of triangles, those that are wanted and without those that lie closer than
/// `clearance` metres under another surface all around: no light gets there. As photons whose flux is their area:
/// `area` m2, or as little as gives a small patch its share.
std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted,
                                    float area, float clearance);

/// Writes the coverage of some nodes of each map (nodes_of_map[m], counted from its first) from samples around them.
/// `references` say which samples belong to which patch, by the same rule as photons; patch_of_map[m] is the patch of
/// m.
void sample_coverage(const PhotonMap& map, const std::vector<NodePoint>& nodes, const std::vector<Photon>& samples,
                     const References& references, const std::vector<uint>& patch_of_map,
                     const std::vector<std::vector<uint>>& nodes_of_map, std::vector<CoverageLevels>& coverage);

/// The levels as the map keeps them.
std::vector<uint> pack_coverage(const std::vector<CoverageLevels>& coverage);

}  // namespace lw
