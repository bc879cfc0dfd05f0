// The table of a lamp's light distribution: columns of C (360 / columns degrees apart, from C0), rows of gamma (from 0
// to 180 degrees) and columns x rows floats, column after column, each a share of the strongest direction. One text for
// C++ and GLSL; the including scope provides the function texel_word: the words of the texels hold the tables.

float profile_entry(uint profile, uint column, uint row) LW_MEMBER {
    uint columns = texel_word(profile);
    uint rows = texel_word(profile + 1u);
    return uintBitsToFloat(texel_word(profile + 2u + (column % columns) * rows + min(row, rows - 1u)));
}

/// Share of the lamp's intensity towards unit `direction`, linear in both angles.
float profile_value(Light lamp, vec3 direction) LW_MEMBER {
    float c = atan(dot(direction, cross(lamp.across, lamp.direction)), dot(direction, lamp.across)) / (2.0f * lw_pi);
    float gamma = atan(length(cross(direction, lamp.direction)), dot(direction, lamp.direction)) /
                  lw_pi;  // acos is coarse on some devices
    float column = (c < 0.0f ? c + 1.0f : c) * float(texel_word(lamp.profile));
    float row = gamma * float(texel_word(lamp.profile + 1u) - 1u);
    uint i = uint(column);
    uint j = uint(row);
    float low = mix(profile_entry(lamp.profile, i, j), profile_entry(lamp.profile, i + 1u, j), column - float(i));
    float high =
        mix(profile_entry(lamp.profile, i, j + 1u), profile_entry(lamp.profile, i + 1u, j + 1u), column - float(i));
    return mix(low, high, row - float(j));
}
