// Gives the triangles that each block keeps their places in the list, by an exclusive scan in one group, where each
// invocation takes a run of blocks. Also sets the sizes of the draws, and fills the last instance of each with
// no_triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "cull.h"
#include "frame_constants.h"

layout(local_size_x = cull_group) in;
layout(set = 1, binding = binding_survivors, scalar) buffer Blocks { Survivors blocks[]; };
layout(set = 1, binding = binding_draws, scalar) writeonly buffer Draws { DrawArguments draws[]; };
layout(set = 1, binding = binding_listed, scalar) writeonly buffer Listed { uint listed[]; };

shared uint sums[cull_group];

uint survivors_of(uint first, uint end) {
    uint sum = 0u;
    for (uint block = first; block < end; ++block) sum += uint(bitCount(blocks[block].mask));
    return sum;
}

/// Places the triangles of the blocks [first_block, end_block) in the list from `first_place` on, and sizes draw
/// `kind`.
void place(uint kind, uint first_block, uint end_block, uint first_place) {
    uint lane = gl_LocalInvocationIndex, run = (end_block - first_block + cull_group - 1u) / cull_group;
    uint first = min(first_block + lane * run, end_block), end = min(first + run, end_block);
    sums[lane] = survivors_of(first, end);
    barrier();
    uint place = first_place, total = 0u;
    for (uint i = 0u; i < cull_group; ++i) {
        if (i < lane) place += sums[i];
        total += sums[i];
    }
    for (uint block = first; block < end; ++block) {
        blocks[block].first_listed = place;
        place += uint(bitCount(blocks[block].mask));
    }
    uint instances = (total + cluster_triangles - 1u) / cluster_triangles;
    if (lane == 0u) draws[kind] = DrawArguments(3u * cluster_triangles, instances, 0u, 0u);
    if (total + lane < instances * cluster_triangles) listed[first_place + total + lane] = no_triangle;
    barrier();
}

void main() {
    uint first_other = first_listed / block_triangles;
    place(0u, 0u, first_other, 0u);
    place(1u, first_other, uint(blocks.length()), first_listed);
}
