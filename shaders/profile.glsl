// The table of a lamp's light distribution, which lies among the texels as 32-bit numbers: how many columns, how many
// rows, then columns x rows floats, column after column. A column is a half plane of C, 360 / columns degrees from the
// next, the first at C0; its rows are gamma from 0 (the lamp's direction) to 180 degrees in equal steps. Each float is
// the intensity as a share of that in the strongest direction, 0 to 1. One text for C++ and GLSL; the including scope
// provides the function texel_word(i), number i of the texels.

/// An entry of the table that begins at number `profile` of the texels. Columns go on around the lamp, a row beyond the
/// last is the last.
float profile_entry(uint profile, uint column, uint row) LW_MEMBER {
    uint columns = texel_word(profile);
    uint rows = texel_word(profile + 1u);
    return uintBitsToFloat(texel_word(profile + 2u + (column % columns) * rows + min(row, rows - 1u)));
}

/// Share of the lamp's strongest intensity that goes in unit `direction`, 0 to 1: linear in both angles between the
/// entries of its table.
float profile_value(Light lamp, vec3 direction) LW_MEMBER {
    float c = atan(dot(direction, cross(lamp.across, lamp.direction)), dot(direction, lamp.across)) / (2.0f * lw_pi);
    // atan instead of acos, which is coarse on some devices.
    float gamma = atan(length(cross(direction, lamp.direction)), dot(direction, lamp.direction)) / lw_pi;
    float column = (c < 0.0f ? c + 1.0f : c) * float(texel_word(lamp.profile));
    float row = gamma * float(texel_word(lamp.profile + 1u) - 1u);
    uint i = uint(column);
    uint j = uint(row);
    float low = mix(profile_entry(lamp.profile, i, j), profile_entry(lamp.profile, i + 1u, j), column - float(i));
    float high =
        mix(profile_entry(lamp.profile, i, j + 1u), profile_entry(lamp.profile, i + 1u, j + 1u), column - float(i));
    return mix(low, high, row - float(j));
}
