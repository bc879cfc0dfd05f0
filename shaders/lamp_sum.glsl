// What both passes of the sum over lamps read: irradiance and unshadowed direct light of each lamp at the nodes,
// sparse.
#include "lamp_sum.h"

layout(local_size_x = lamp_sum_group) in;
layout(push_constant, scalar) uniform Push { LampSumPush push; };
layout(set = 0, binding = binding_lamp_terms, scalar) readonly buffer Terms { LampTerm terms[]; };

/// Where entry `i` of a sparse array lies, given its mark and start (maps/sparse_array.h); no_place for a
/// zero.
uint sparse_place(uvec2 mark_and_start, uint i) {
    uint bit = 1u << (i % 32u);
    if ((mark_and_start.x & bit) == 0u) return no_place;
    return mark_and_start.y + uint(bitCount(mark_and_start.x & (bit - 1u)));
}
