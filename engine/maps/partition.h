// The surfaces of a scene parted into patches, each of which gets a photon grid of its own. Follows from the geometry
// and the settings of a bake alone, not from its photons.
#pragma once
#include "maps/neighbours.h"
#include "maps/patches.h"
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

struct Partition {
    Patches patches;                    // which patch each point of a surface lies on, and the cuts between them
    std::vector<PatchShape> shapes;     // of each patch
    std::vector<float> scales;          // of each patch, m: what lattices, cuts and tolerances on it follow
    std::vector<float> node_distances;  // of the lattice of each patch, m, at most
    float neighbour_angle_deg;          // largest angle between the normals of a photon and a patch that refers to it
    std::vector<float> radii;           // search radius of each patch, m; at most that with which neighbours were found
    Neighbours neighbours;              // which patches may refer to the photons of each
};

constexpr float max_overhang = 1.1f;
constexpr float nodes_apart = 0.5f;  // scales between the nodes of a lattice, at most

/// Parts the surfaces into patches, cut where walls stand on them (cuts.h). With a radius in `settings` it is the scale
/// of all: patches of 6 radii or one large triangle (patches.h); small patches get a smaller radius, at least half of
/// it. Else scales follow the surroundings (local_patches.h, tiles.h); search radii are up to 2.5 scales.
Partition partition_surfaces(const Scene& scene, const RayCaster& caster, const BakeSettings& settings);

/// What the lattice of a patch follows: its surroundings alone, or its photons too where these are denser.
enum class Follow { surroundings, photons };

/// Lowers the search radius of each patch to that of a disc with 250 photons at the mean density of its own, but not
/// below what its lattice shows, twice the distance of nodes.
void lower_radii(const Scene& scene, const std::vector<Photon>& photons, Follow follow, Partition& partition);

/// The radius of each patch: the one of `largest`, but so small that the photons around a small patch do not outnumber
/// those on it: the overhang (P r + pi r^2) / A of its rectangle stays below max_overhang, unless the radius is below
/// the part `floor` of the largest.
std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, std::vector<float> largest, float floor);

}  // namespace lw
