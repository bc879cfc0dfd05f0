// Which patches refer to a photon: its own, and those near it whose surface it may belong to.
#pragma once
#include <vector>

#include "maps/partition.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// What a search for references reads; all of it must outlive the search.
struct ReferenceInput {
    const Scene& scene;
    const RayCaster& caster;
    const Partition& partition;
    const std::vector<Photon>& photons;
};

/// A reference to a photon of another patch.
struct NeighbourReference {
    uint patch, photon;
};

/// Finds the patches of one photon after another. A photon belongs to a patch when it lies within the patch's radius of
/// its triangle (of the boxes around it, when the patch has several), when
/// its normal is within the angle of the patch's, and when its height over the patch is no more than what the angle
/// between the two explains: a parallel sheet above or below does not belong, nor does what lies behind a wall: on a
/// plane, the nearest point of the patch must be in sight.
class PatchFinder {
  public:
    explicit PatchFinder(const ReferenceInput& input);
    ~PatchFinder();

    /// The patch that a photon, given by its index, lies on.
    uint own_patch(uint photon) const {
        const Photon& p = in_.photons[photon];
        return in_.partition.patches.at(2 * p.triangle + p.side(), p.position);
    }

    /// Appends every other patch than its `own` that refers to a photon. Returns whether its own does.
    bool find(uint photon, uint own, std::vector<NeighbourReference>& found) const;

  private:
    struct PatchBoxes;
    /// From a photon's own patch to another.
    struct Sight {
        uint own, patch;
    };

    vec3 normal_of(const Photon& photon) const;
    bool belongs(vec3 position, vec3 normal, uint patch) const;
    vec3 nearest_point(vec3 position, vec3 local, const PatchShape& shape) const;
    bool is_in_sight(vec3 position, vec3 normal, Sight sight) const;
    bool is_before_the_wall(vec3 position, vec3 normal, uint own) const;
    float lift_of(float scale) const;
    bool is_clear(vec3 position, vec3 normal, vec3 way, float lift) const;

    const ReferenceInput in_;
    std::vector<PatchBoxes> boxes_;
    float cos_angle_;
};

}  // namespace lw
