// The bounding volume hierarchy that rays in compute shaders traverse, shared by C++ and GLSL. Nodes are in depth-first
// order with skip links, so a traversal needs no stack.
#ifndef LW_BVH_H
#define LW_BVH_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

/// A bit set in the entries of triangles that may let light through: alpha masks, blends, thin glass.
LW_CONST uint bvh_see_through = 0x80000000u;

/// A node. The traversal goes to the next node of the array when the ray meets the box of an inner node, and to node
/// `skip` otherwise.
struct BvhNode {
    vec3 low;
    uint skip;  // index of the first node after this subtree
    vec3 high;
    uint leaf;  // 0: inner node; else first entry of the triangle list << 4 | number of triangles (1 to 15)
};

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 32 && offsetof(BvhNode, leaf) == 28);
}  // namespace lw
#endif
#endif
