#include "trace/sampling.h"

#include <array>

namespace lw {
namespace {

using DirectionNumbers = std::array<std::array<uint32_t, 32>, 5>;

/// Joe & Kuo (2008), new-joe-kuo-6: degree s, coefficients a, initial m of dimensions 2..5.
struct Polynomial {
    uint32_t s, a;
    std::array<uint32_t, 3> m;
};
constexpr std::array<Polynomial, 4> polynomials{{{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}}};

constexpr DirectionNumbers make_direction_numbers() {
    DirectionNumbers v{};
    for (uint32_t i = 0; i < 32; ++i) v[0][i] = 1u << (31 - i);
    for (size_t d = 1; d < 5; ++d) {
        const Polynomial p = polynomials[d - 1];
        for (uint32_t i = 0; i < p.s; ++i) v[d][i] = p.m[i] << (31 - i);
        for (uint32_t i = p.s; i < 32; ++i) {
            v[d][i] = v[d][i - p.s] ^ (v[d][i - p.s] >> p.s);
            for (uint32_t j = 1; j < p.s; ++j)
                if ((p.a >> (p.s - 1 - j)) & 1u) v[d][i] ^= v[d][i - j];
        }
    }
    return v;
}

constexpr uint32_t reverse_bits(uint32_t x) {
    x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
}

/// Tables for 4 bits of an index at a time: [dimension][group of 4 bits][value] is the XOR of the direction numbers of
/// the bits set in the value. The bits are stored reversed, as the scrambling takes them.
using NibbleSums = std::array<std::array<std::array<uint32_t, 16>, 8>, 5>;

constexpr NibbleSums sum_direction_numbers() {
    const DirectionNumbers v = make_direction_numbers();
    NibbleSums sums{};
    for (size_t d = 0; d < 5; ++d)
        for (size_t nibble = 0; nibble < 8; ++nibble)
            for (size_t value = 0; value < 16; ++value)
                for (size_t bit = 0; bit < 4; ++bit)
                    if (value >> bit & 1u) sums[d][nibble][value] ^= reverse_bits(v[d][4 * nibble + bit]);
    return sums;
}

constexpr NibbleSums nibble_sums = sum_direction_numbers();

/// Laine & Karras (2011) permutation with the constants of Vegdahl; scrambles from the low bits up.
uint32_t laine_karras(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

}  // namespace

float sobol_owen(uint32_t index, int dimension, uint32_t seed) {
    uint32_t x = 0;
    for (const auto& sums : nibble_sums[size_t(dimension)]) {
        x ^= sums[index & 15u];
        index >>= 4;
    }
    const auto scramble = uint32_t(mix64((uint64_t(seed) << 8) | uint64_t(dimension)));
    return to_unit_float(reverse_bits(laine_karras(x, scramble)));
}

}  // namespace lw
