#include "daylight/sky_shape.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

/// a to e of the general skies (CIE S 011, table 1).
constexpr std::array<std::array<double, 5>, 15> standard{{{4.0, -0.70, 0, -1.0, 0},
                                                          {4.0, -0.70, 2, -1.5, 0.15},
                                                          {1.1, -0.8, 0, -1.0, 0},
                                                          {1.1, -0.8, 2, -1.5, 0.15},
                                                          {0, -1.0, 0, -1.0, 0},
                                                          {0, -1.0, 2, -1.5, 0.15},
                                                          {0, -1.0, 5, -2.5, 0.30},
                                                          {0, -1.0, 10, -3.0, 0.45},
                                                          {-1.0, -0.55, 2, -1.5, 0.15},
                                                          {-1.0, -0.55, 5, -2.5, 0.30},
                                                          {-1.0, -0.55, 10, -3.0, 0.45},
                                                          {-1.0, -0.32, 10, -3.0, 0.45},
                                                          {-1.0, -0.32, 16, -3.0, 0.30},
                                                          {-1.0, -0.15, 16, -3.0, 0.30},
                                                          {-1.0, -0.15, 24, -2.8, 0.15}}};

}  // namespace

SkyShape cie_sky(int type) {
    assert(type >= 1 && type <= 15);
    const std::array<double, 5>& s = standard[size_t(type - 1)];
    return {s[0], s[1], 1 - s[2] * std::exp(s[3] * pi / 2), s[2], s[3], s[4]};
}

double value_of(const SkyShape& shape, double cos_zenith, double cos_sun) {
    constexpr double lowest = 0.01;  // of cos Z: b of Perez may be positive, and there is a pole at the horizon
    const double angle = std::acos(std::clamp(cos_sun, -1.0, 1.0));
    const double gradation = 1 + shape.a * std::exp(shape.b / std::max(cos_zenith, lowest));
    const double indicatrix = shape.floor + shape.c * std::exp(shape.d * angle) + shape.e * cos_sun * cos_sun;
    return std::max(gradation, 0.0) * std::max(indicatrix, 0.0);
}

double horizontal_value(const SkyShape& shape, double sun_zenith) {
    // The middles of rings of equal height and of their parts on one side of the sun; the other side is alike.
    constexpr int rings = 180, parts = 180;
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const double zenith = (ring + 0.5) * pi / 2 / rings, cosine = std::cos(zenith), sine = std::sin(zenith);
        double of_ring = 0;
        for (int part = 0; part < parts; ++part) {
            const double turn = (part + 0.5) * pi / parts;
            of_ring +=
                value_of(shape, cosine, cosine * std::cos(sun_zenith) + sine * std::sin(sun_zenith) * std::cos(turn));
        }
        sum += of_ring * cosine * sine;
    }
    return sum * (pi / 2 / rings) * (2 * pi / parts);
}

double zenith_ratio(const SkyShape& shape, double sun_zenith) {
    return value_of(shape, 1, std::cos(sun_zenith)) / horizontal_value(shape, sun_zenith);
}

}  // namespace lw
