// How much of a kernel lies on surface that light can reach. Density estimates are divided by it, so that edges,
// corners and the feet of furniture neither darken nor glow (boundary bias; Jensen 2001, section 7.4).
#pragma once
#include <vector>

#include "base/random.h"
#include "maps/lattice.h"
#include "maps/references.h"
#include "trace/ray_caster.h"

namespace lw {

/// Surfaces closer than this under another one get no light.
inline float clearance_of(float radius) { return 0.25f * radius; }

/// True when every one of a few rays into the hemisphere meets a surface lower than `clearance` over the point.
bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng);

/// Evenly spread points on both sides of all triangles, without those that lie closer than `clearance` metres under
/// another surface all around: no light gets there. As photons whose flux is their area: `area` m2, or as little as
/// gives a small patch its share.
std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const Patches& patches, float area,
                                    float clearance);

/// The coverage of each node, packed by pack_coverage(). `references` say which samples belong to which patch, by the
/// same rule as photons; patch_of_map[m] is the patch of map m.
std::vector<uint> find_coverage(const Scene& scene, const PhotonMap& map, const std::vector<NodePoint>& nodes,
                                const std::vector<Photon>& samples, const References& references,
                                const std::vector<uint>& patch_of_map);

}  // namespace lw
