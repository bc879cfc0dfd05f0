// Coverage: the part of a kernel that lies on surface where light can arrive. Density estimates are divided by it, so
// that they are neither too dark nor too bright at edges, in corners and at the feet of furniture (boundary bias;
// Jensen 2001, section 7.4).
#pragma once
#include <vector>

#include "maps/flat_coverage.h"

namespace lw {

/// The coverage of all nodes, one word of four levels each (see unpack_coverage()). In closed form where the ground is
/// plane, elsewhere from samples of the surfaces: one every 0.03 R^2, so 26 under a kernel of radius R/2.
std::vector<uint> find_coverage(const CoverageInput& input);

}  // namespace lw
