// Finds the patches that refer to a photon: its own, and those near it to whose surface it may belong.
#pragma once
#include <vector>

#include "maps/partition.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// The input of a search for references, by reference.
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

/// Finds the patches that refer to a photon. A patch does so when all of this holds. The photon lies within the patch's
/// radius of its triangle, or, when it has several, of the box around them. The photon's normal is within the angle of
/// the patch's. Its height over the patch is no more than the angle between the two explains, so that parallel surfaces
/// above or below do not count. In the same plane, the nearest point of the patch is in sight, so that photons behind a
/// wall do not count.
class PatchFinder {
  public:
    explicit PatchFinder(const ReferenceInput& input);
    ~PatchFinder();

    /// The patch on which the photon with this index lies.
    uint own_patch(uint photon) const {
        const Photon& p = in_.photons[photon];
        return in_.partition.patches.at(2 * p.triangle + p.side(), p.position);
    }

    /// Appends a reference for every patch other than `own` that refers to a photon. Returns true when its own patch
    /// refers to it too.
    bool find(uint photon, uint own, std::vector<NeighbourReference>& found) const;

  private:
    struct PatchBoxes;

    vec3 normal_of(const Photon& photon) const;
    bool belongs(vec3 position, vec3 normal, uint patch) const;
    vec3 nearest_point(vec3 position, vec3 local, const PatchShape& shape) const;
    bool is_in_sight(vec3 position, vec3 normal, uint patch) const;
    bool is_before_the_wall(vec3 position, vec3 normal, uint own) const;
    bool is_clear(vec3 position, vec3 normal, vec3 way) const;

    const ReferenceInput in_;
    std::vector<PatchBoxes> boxes_;
    float largest_, cos_angle_;
};

}  // namespace lw
