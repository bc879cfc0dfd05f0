// Which photons each patch refers to (paper, section 2.1): those on it, and those within
// its radius whose normal differs by less than the angle. Lists of neighbours per cell of a patch replace the paper's
// lists per triangle, which grow with the square of the triangles.
#pragma once
#include "maps/patch_finder.h"

namespace lw {

/// References sorted by patch: those of patch p are photons[starts[p]] .. photons[starts[p + 1] - 1].
struct References {
    std::vector<uint64_t> starts;  // patches + 1
    std::vector<uint> photons;     // indices of photons, ascending within a patch
};

/// All references to the photons, by the rule of PatchFinder.
References find_references(const ReferenceInput& input);

/// The mean number of references per photon, from about `samples` photons spread over the whole set.
double sample_references(const ReferenceInput& input, size_t samples);

/// The partition with smaller radii of small patches, until references per photon stay below 2.3.
Partition limit_references(const Scene& scene, const RayCaster& caster, const std::vector<Photon>& photons,
                           Partition partition);

}  // namespace lw
