// Records of the culling of triangles, in a descriptor set of the culling passes and of visibility.vert. Stream
// compaction as in Harris, Sengupta, Owens: Parallel Prefix Sum (Scan) with CUDA (GPU Gems 3, chapter 39).
#ifndef LW_CULL_H
#define LW_CULL_H
#include "frame.h"
#ifdef __cplusplus
namespace lw {
#endif

/// A group of up to cluster_triangles triangles that follow each other in the scene. Clusters whose triangles are all
/// opaque come first in the array.
struct Cluster {
    vec3 low;  // bounds
    uint first;
    vec3 high;
    uint end;  // triangles [first, end)
};
LW_CONST uint cluster_texels = 2u;

/// Number of triangles that one invocation tests: a block.
LW_CONST uint block_triangles = 32u;
LW_CONST uint blocks_per_cluster = cluster_triangles / block_triangles;
LW_CONST uint cull_group = 64u;  // invocations

/// What culling found of a block: a bit for each triangle that may cover the centre of a pixel, and the place of the
/// first of these in the list.
struct Survivors {
    uint mask;
    uint first_listed;
};

/// VkDrawIndirectCommand: an instance for every cluster_triangles triangles of the list.
struct DrawArguments {
    uint vertices;
    uint instances;
    uint first_vertex;
    uint first_instance;
};

#ifdef __cplusplus
static_assert(sizeof(Cluster) == 16 * cluster_texels && offsetof(Cluster, end) == 28);
static_assert(sizeof(Survivors) == 8 && sizeof(DrawArguments) == 16);
}  // namespace lw
#endif
#endif
