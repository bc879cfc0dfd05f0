// Warps of uniform numbers u, v in [0, 1) to directions and points, and the quasi-random numbers for photon emission.
#pragma once
#include <cmath>

#include "base/random.h"
#include "shaders/scene.h"

namespace lw {

/// Orthonormal basis around unit n as columns (t, b, n) (Duff et al. 2017).
inline mat3 frame_around(vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return mat3(vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n);
}

/// Uniform on the unit disc.
inline vec2 sample_disc(float u, float v) {
    const float r = std::sqrt(u), phi = 2 * lw_pi * v;
    return {r * std::cos(phi), r * std::sin(phi)};
}

/// Cosine-weighted on the hemisphere around +Z; pdf = cos / pi.
inline vec3 sample_cosine(float u, float v) {
    const vec2 d = sample_disc(u, v);
    return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - u))};
}

/// Unit direction with the given cosine to +Z; `v` in [0, 1) turns it around the axis.
inline vec3 direction_of(float cosine, float v) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), phi = 2 * lw_pi * v;
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// The weight of a sample drawn with density `a` that another strategy draws with density `b` (Veach 1997,
/// section 9.2).
inline float power_heuristic(float a, float b) { return a * a / (a * a + b * b); }

/// Element `index`, dimension 0 to 4, of the Sobol sequence with Owen scrambling, in [0, 1): direction numbers of Joe &
/// Kuo (2008), hash-based scrambling of Burley (2020). Sequences of different `seed` are independent.
float sobol_owen(uint32_t index, int dimension, uint32_t seed);

}  // namespace lw
