// The bounding volume hierarchy that rays in compute shaders traverse, as plain arrays (shaders/bvh.h). Built by
// trace/build_bvh.
#pragma once
#include <vector>

#include "shaders/bvh.h"

namespace lw {

/// Both arrays are empty when no ray is ever traced.
struct Bvh {
    std::vector<BvhNode> nodes;   // depth first
    std::vector<uint> triangles;  // triangle ids in leaf order, with bvh_see_through
};

}  // namespace lw
