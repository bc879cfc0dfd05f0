// Second pass of the sum over lamps: for each lattice cell the irradiance at its four corners, with the lamps' own
// light that the cell holds, packed as the gather reads it. Where lamps change one by one, the own light is kept apart
// too: four vectors a cell.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamp_sum.glsl"

layout(set = 0, binding = binding_lattice_columns) uniform utextureBuffer lattice_columns;
layout(set = 0, binding = binding_sum_lattice_rows) uniform utextureBuffer rows_of_lattices;
layout(set = 0, binding = binding_direct_marks) uniform utextureBuffer direct_marks;
layout(set = 0, binding = binding_direct_values) uniform utextureBuffer direct_values;
layout(set = 0, binding = binding_node_sum_texels) uniform textureBuffer node_sums;
// From push.first on.
layout(set = 0, binding = binding_cell_direct, scalar) buffer CellDirect { vec3 cell_direct[]; };
layout(set = 0, binding = binding_cell_sums, scalar) writeonly buffer CellSums { uvec4 cell_sums[]; };

/// lux at a node from a lamp at intensity 1.
float direct_at(uint punctual, uint node) {
    uint entry = punctual * push.nodes + node;
    uint place = sparse_place(texelFetch(direct_marks, int(entry / 32u)).xy, entry);
    return place == no_place ? 0.0f : uintBitsToFloat(texelFetch(direct_values, int(place)).x);
}

/// True when the light of a lattice cell holds the lamp's own light.
bool holds(uint cell, uint lamp) {
    uint column = push.first_lamp_column + lattice_lamp_column(lamp);
    uint bits = texelFetch(rows_of_lattices, int(cell * push.row_length + column)).x;
    return ((bits >> lattice_lamp_shift(lamp)) & in_lattice_light) != 0u;
}

void main() {
    uint cell = push.first + gl_GlobalInvocationID.x;
    if (cell >= push.end) return;
    uint columns = texelFetch(lattice_columns, int(cell)).x;
    if (columns == 0u) return;  // the last column or row begins no cell
    uint corners[4] = uint[4](cell, cell + 1u, cell + columns, cell + columns + 1u);
    precise vec3 e[4];
    vec3 direct[4];  // the part of e that is the lamps' own light
    uint local = cell - push.first;
    bool adds = push.keeps_direct != 0u && push.adds != 0u;
    for (uint c = 0u; c < 4u; ++c) {
        direct[c] = adds ? cell_direct[4u * local + c] : vec3(0.0f);
        e[c] = texelFetch(node_sums, int(corners[c])).xyz + direct[c];
    }
    for (uint t = 0u; t < push.terms; ++t) {
        if (terms[t].punctual == no_place || !holds(cell, terms[t].lamp)) continue;
        for (int c = 0; c < 4; ++c) {
            precise vec3 part = terms[t].power * (push.record_scale * direct_at(terms[t].punctual, corners[c]));
            e[c] += part;
            direct[c] += part;
        }
    }
    for (uint c = 0u; push.keeps_direct != 0u && c < 4u; ++c) cell_direct[4u * local + c] = direct[c];
    cell_sums[local] = uvec4(pack_rgb9e5(e[0]), pack_rgb9e5(e[1]), pack_rgb9e5(e[2]), pack_rgb9e5(e[3]));
}
