// Which photons each map refers to (paper, section 2.1): the photon's own, and those within the map's radius whose
// normal differs by less than the angle. Lists of neighbours per cell of a patch replace the paper's lists per
// triangle, which grow with the square of the triangles.
#pragma once
#include <vector>

#include "maps/neighbours.h"
#include "maps/patches.h"
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw {

/// References sorted by map: those of map m are photons[starts[m]] .. photons[starts[m + 1] - 1].
struct References {
    std::vector<uint64_t> starts;  // patches + 1
    std::vector<uint> photons;     // indices of photons, ascending within a map
};

/// What a search for references reads; all of it must outlive the search.
struct ReferenceInput {
    const Scene& scene;
    const std::vector<Photon>& photons;
    const Patches& patches;
    const std::vector<PatchShape>& shapes;
    const std::vector<float>& radii;  // search radius of each patch, m; at most those of the neighbours
    float neighbour_angle_deg;
    const Neighbours& neighbours;
    const RayCaster& caster;
};

constexpr float max_overhang = 1.1f;

/// The radius of each patch: `largest`, but so small that the photons around a small patch do not outnumber those on
/// it: the overhang (P r + pi r^2) / A of its rectangle stays below `overhang`, unless the radius is below `floor`
/// metres.
std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor,
                               float overhang = max_overhang);

/// A photon belongs to a patch when it lies within the patch's radius of its triangle (of the box around it, when the
/// patch has several, and within the largest radius of its bounds), when its normal is within the angle of the patch's,
/// and when its height over the patch is no more than what the angle between the two explains: a parallel sheet above
/// or below does not belong, nor does what lies behind a wall: on a plane, the nearest point of the patch must be in
/// sight.
References find_references(const ReferenceInput& input);

/// References per photon from about `samples` photons spread over the whole set.
double sample_references(const ReferenceInput& input, size_t samples);

}  // namespace lw
