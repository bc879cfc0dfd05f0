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

}  // namespace lw
