// First pass of the sum over lamps: irradiance at each node of the lattice, all lamps at their power, or what lamps
// that changed add to it. The order of the additions is that of LatticeLight::sum(), and so are the bits of a whole
// sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamp_sum.glsl"

layout(set = 0, binding = binding_irradiance_marks) uniform utextureBuffer irradiance_marks;
layout(set = 0, binding = binding_irradiance_values) uniform utextureBuffer irradiance_values;
layout(set = 0, binding = binding_node_sums, scalar) buffer NodeSums { vec4 node_sums[]; };  // from push.first on

void main() {
    uint node = push.first + gl_GlobalInvocationID.x;
    if (node >= push.end) return;
    precise vec3 e = push.adds != 0u ? node_sums[node - push.first].xyz : vec3(0.0f);
    for (uint t = 0u; t < push.terms; ++t) {
        uint entry = terms[t].lamp * push.nodes + node;
        uint place = sparse_place(texelFetch(irradiance_marks, int(entry / 32u)).xy, entry);
        if (place == no_place) continue;
        precise vec3 part = unpack_rgb9e5(texelFetch(irradiance_values, int(place)).x) * terms[t].scaled_power;
        e += part;
    }
    node_sums[node - push.first] = vec4(e, 0.0f);
}
