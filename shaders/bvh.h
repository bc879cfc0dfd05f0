// Bounding volume hierarchy for shadow rays in compute, shared by C++ and GLSL: nodes in depth-first order with skip
// links, so that a traversal needs no stack.
#ifndef LW_BVH_H
#define LW_BVH_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

/// Set in the entries of triangles that may let light through: cut-outs, blends, thin glass.
LW_CONST uint bvh_see_through = 0x80000000u;

/// Next node is the following one when the box is hit and the node is inner, otherwise `skip`.
struct BvhNode {
    vec3 low;
    uint skip;  // first node behind this subtree
    vec3 high;
    uint leaf;  // 0: inner node; else first entry of the triangle list << 4 | number of triangles (1 to 15)
};

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 32 && offsetof(BvhNode, leaf) == 28);
}  // namespace lw
#endif
#endif
