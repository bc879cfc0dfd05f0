// Sets the sizes of the dispatches for all lists of pixels from their counts. A shader of its own, as a second atomic
// per listed pixel would cost more, and so would another pipeline of gather.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "frame.h"

layout(local_size_x = gather_group_side, local_size_y = gather_group_side) in;
layout(set = 1, binding = binding_ray_lists, scalar) buffer RayLists { RayPixels ray_lists[]; };

void main() {
    const uint group = gather_group_side * gather_group_side;
    for (uint list = gl_LocalInvocationIndex; list < uint(ray_lists.length()); list += group)
        ray_lists[list].groups_x = (ray_lists[list].count + group - 1u) / group;
}
