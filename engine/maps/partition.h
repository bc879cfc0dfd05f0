// The surfaces of a scene parted into patches, each of which gets a photon grid of its own. Follows from the scene and
// the settings of a bake alone, not from its photons.
#pragma once
#include "maps/neighbours.h"
#include "maps/patches.h"
#include "maps/photon_map.h"

namespace lw {

struct Partition {
    Patches patches;                 // which patch each point of a surface lies on, and the cuts between them
    std::vector<PatchShape> shapes;  // of each patch
    float radius;                    // largest search radius, m
    float neighbour_angle_deg;       // largest angle between the normals of a photon and a patch that refers to it
    std::vector<float> radii;        // search radius of each patch, m; at most that with which neighbours were found
    Neighbours neighbours;           // which patches may refer to the photons of each
};

constexpr float first_floor = 0.5f;  // of the largest radius: what the radii of small patches are first lowered to
constexpr float max_overhang = 1.1f;

/// Parts the surfaces for the largest radius of `settings`, which is given: patches of 6 radii or one large triangle
/// (patches.h), cut where walls stand on them (cuts.h). Small patches get a smaller radius, at least half of it.
Partition partition_surfaces(const Scene& scene, const BakeSettings& settings);

/// The radius of each patch: `largest`, but so small that the photons around a small patch do not outnumber those on
/// it: the overhang (P r + pi r^2) / A of its rectangle stays below `overhang`, unless the radius is below `floor`
/// metres.
std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor,
                               float overhang = max_overhang);

}  // namespace lw
