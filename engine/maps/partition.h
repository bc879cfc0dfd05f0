// The partition of a scene's surfaces into patches, each of which gets a photon grid of its own. It depends on the
// scene and the settings of a bake, not on photons.
#pragma once
#include "maps/neighbours.h"
#include "maps/patches.h"
#include "maps/photon_map.h"

namespace lw {

struct Partition {
    Patches patches;                 // tells which patch a point of a surface lies on; holds the cuts
    std::vector<PatchShape> shapes;  // of each patch
    float radius;                    // largest search radius, m
    float neighbour_angle_deg;       // largest angle between the normals of a photon and a patch that refers to it
    std::vector<float> radii;  // search radius of each patch, m; at most the radius with which neighbours were found
    Neighbours neighbours;     // which patches may refer to the photons of each
};

constexpr float first_floor = 0.5f;  // in largest radii: the least radius of small patches at first
constexpr float max_overhang = 1.1f;

/// Divides the surfaces into patches: single large triangles, or groups of small ones up to 6 search radii wide
/// (patches.h), cut where walls stand on them (cuts.h). settings.radius must not be 0; small patches get a smaller one,
/// at least half of it.
Partition partition_surfaces(const Scene& scene, const BakeSettings& settings);

/// The search radius of each patch, m: `largest`, or less for small patches, so that photons around a patch do not
/// outnumber those on it. The condition is (P r + pi r^2) / A <= `overhang` for the perimeter P and area A of its
/// rectangle; the radius is not reduced below `floor` m for it.
std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor,
                               float overhang = max_overhang);

}  // namespace lw
