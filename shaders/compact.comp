// Writes the triangles that each block keeps to the list, in the scene's order.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "cull.h"

layout(local_size_x = cull_group) in;
layout(set = 1, binding = binding_clusters) uniform utextureBuffer clusters;
layout(set = 1, binding = binding_survivors, scalar) readonly buffer Blocks { Survivors blocks[]; };
layout(set = 1, binding = binding_listed, scalar) writeonly buffer Listed { uint listed[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    if (block >= uint(blocks.length())) return;
    uint cluster = block / blocks_per_cluster, mask = blocks[block].mask, place = blocks[block].first_listed;
    uint first = texelFetch(clusters, int(cluster_texels * cluster)).w + block % blocks_per_cluster * block_triangles;
    for (; mask != 0u; mask &= mask - 1u) listed[place++] = first + uint(findLSB(mask));
}
