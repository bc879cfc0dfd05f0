// Coverage: the part of a kernel that lies on surface where light can arrive. Density estimates are divided by it, so
// that they are neither too dark nor too bright at edges, in corners and at the feet of furniture (boundary bias;
// Jensen 2001, section 7.4).
#pragma once
#include <vector>

#include "maps/flat_coverage.h"

namespace lw {

/// The coverage of all nodes, as the map keeps it: in closed form where the ground is plane, from samples elsewhere,
/// one every 0.03 R2, on curved patches 0.01 R2 (20 under the smallest kernel, R/4).
std::vector<uint> find_coverage(const CoverageInput& input);

}  // namespace lw
