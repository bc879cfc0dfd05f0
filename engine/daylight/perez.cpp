#include "daylight/perez.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double solar_constant = 1367;  // W/m2, as in the papers

/// Lower ends of the classes of clearness but the first (1990, table 1; 1993, table 1).
constexpr std::array<double, 7> class_ends{1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200};

size_t class_of(double clearness) {
    return size_t(std::upper_bound(class_ends.begin(), class_ends.end(), clearness) - class_ends.begin());
}

/// For a to e four numbers each (1993, table 1).
using ShapeRow = std::array<std::array<double, 4>, 5>;
constexpr std::array<ShapeRow, 8> shapes{{
    {{{1.3525, -0.2576, -0.2690, -1.4366},
      {-0.7670, 0.0007, 1.2734, -0.1233},
      {2.8000, 0.6004, 1.2375, 1.0000},
      {1.8734, 0.6297, 0.9738, 0.2809},
      {0.0356, -0.1246, -0.5718, 0.9938}}},
    {{{-1.2219, -0.7730, 1.4148, 1.1016},
      {-0.2054, 0.0367, -3.9128, 0.9156},
      {6.9750, 0.1774, 6.4477, -0.1239},
      {-1.5798, -0.5081, -1.7812, 0.1080},
      {0.2624, 0.0672, -0.2190, -0.4285}}},
    {{{-1.1000, -0.2515, 0.8952, 0.0156},
      {0.2782, -0.1812, -4.5000, 1.1766},
      {24.7219, -13.0812, -37.7000, 34.8438},
      {-5.0000, 1.5218, 3.9229, -2.6204},
      {-0.0156, 0.1597, 0.4199, -0.5562}}},
    {{{-0.5484, -0.6654, -0.2672, 0.7117},
      {0.7234, -0.6219, -5.6812, 2.6297},
      {33.3389, -18.3000, -62.2500, 52.0781},
      {-3.5000, 0.0016, 1.1477, 0.1062},
      {0.4659, -0.3296, -0.0876, -0.0329}}},
    {{{-0.6000, -0.3566, -2.5000, 2.3250},
      {0.2937, 0.0496, -5.6812, 1.8415},
      {21.0000, -4.7656, -21.5906, 7.2492},
      {-3.5000, -0.1554, 1.4062, 0.3988},
      {0.0032, 0.0766, -0.0656, -0.1294}}},
    {{{-1.0156, -0.3670, 1.0078, 1.4051},
      {0.2875, -0.5328, -3.8500, 3.3750},
      {14.0000, -0.9999, -7.1406, 7.5469},
      {-3.4000, -0.1078, -1.0750, 1.5702},
      {-0.0672, 0.4016, 0.3017, -0.4844}}},
    {{{-1.0000, 0.0211, 0.5025, -0.5119},
      {-0.3000, 0.1922, 0.7023, -1.6317},
      {19.0000, -5.0000, 1.2438, -1.9094},
      {-4.0000, 0.0250, 0.3844, 0.2656},
      {1.0468, -0.3788, -2.4517, 1.4656}}},
    {{{-1.0500, 0.0289, 0.4260, 0.3590},
      {-0.3250, 0.1156, 0.7781, 0.0025},
      {31.0625, -14.5000, -46.1148, 55.3750},
      {-7.2312, 0.4050, 13.3500, 0.6234},
      {1.5000, -0.6426, 1.8564, 0.5636}}},
}};

/// Luminous efficacy, lm/W (1990, table 4).
using EfficacyRow = std::array<double, 4>;
constexpr std::array<EfficacyRow, 8> diffuse_efficacy{{{97.24, -0.46, 12.00, -8.91},
                                                       {107.22, 1.15, 0.59, -3.95},
                                                       {104.97, 2.96, -5.53, -8.77},
                                                       {102.39, 5.59, -13.95, -13.90},
                                                       {100.71, 5.94, -22.75, -23.74},
                                                       {106.42, 3.83, -36.15, -28.83},
                                                       {141.88, 1.90, -53.24, -14.03},
                                                       {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<EfficacyRow, 8> direct_efficacy{{{57.20, -4.55, -2.98, 117.12},
                                                      {98.99, -3.46, -1.21, 12.38},
                                                      {109.83, -4.90, -1.71, -8.81},
                                                      {110.34, -5.84, -1.99, -4.56},
                                                      {106.36, -3.97, -1.75, -6.16},
                                                      {107.19, -1.25, -1.51, -26.73},
                                                      {105.75, 0.77, -1.26, -34.44},
                                                      {101.18, 1.58, -1.10, -8.29}}};

/// How much more air the light of the sun crosses than from the zenith (Kasten 1965, as the papers take it).
double air_mass(double zenith) {
    const double degrees = std::min(zenith * 180 / pi, 90.0);
    return 1 / (std::max(std::cos(zenith), 0.0) + 0.15 * std::pow(93.885 - degrees, -1.253));
}

}  // namespace

SkyState sky_state(const Irradiances& m) {
    constexpr double least_diffuse = 1e-6, least_brightness = 0.01, most_brightness = 0.6, most_clearness = 11.9;
    const double diffuse = std::max(m.diffuse_horizontal, least_diffuse);
    const double zenith = std::clamp(m.sun_zenith, 0.0, pi / 2), cubed = 1.041 * zenith * zenith * zenith;
    const double clearness = ((diffuse + m.direct_normal) / diffuse + cubed) / (1 + cubed);
    const double outside = solar_constant / (m.sun_distance * m.sun_distance);
    return {std::clamp(clearness, 1.0, most_clearness),
            std::clamp(diffuse * air_mass(zenith) / outside, least_brightness, most_brightness)};
}

SkyShape perez_sky(const SkyState& state, double sun_zenith) {
    const size_t row = class_of(state.clearness);
    const double zenith = std::clamp(sun_zenith, 0.0, pi / 2);
    // The fit has no data there: the authors' own program takes the brightness to be at least this.
    const bool dim = state.clearness > 1.065 && state.clearness < 2.8 && state.brightness < 0.2;
    const double delta = dim ? 0.2 : state.brightness;
    std::array<double, 5> p{};
    for (size_t i = 0; i < 5; ++i) {
        const std::array<double, 4>& x = shapes[row][i];
        p[i] = x[0] + x[1] * zenith + delta * (x[2] + x[3] * zenith);
    }
    if (row == 0) {  // equations 7 and 8
        const std::array<double, 4>&c = shapes[row][2], &d = shapes[row][3];
        p[2] = std::exp(std::pow(delta * (c[0] + c[1] * zenith), c[2])) - c[3];
        p[3] = -std::exp(delta * (d[0] + d[1] * zenith)) + d[2] + delta * d[3];
    }
    return {p[0], p[1], 1, p[2], p[3], p[4]};
}

Illuminances illuminances_of(const Irradiances& m) {
    const SkyState state = sky_state(m);
    const size_t row = class_of(state.clearness);
    const double zenith = std::clamp(m.sun_zenith, 0.0, pi / 2);
    const double water = std::exp(0.07 * m.dew_point - 0.075);  // cm of it above the place, equation 3
    const EfficacyRow &d = diffuse_efficacy[row], &b = direct_efficacy[row];
    const double diffuse = d[0] + d[1] * water + d[2] * std::cos(zenith) + d[3] * std::log(state.brightness);
    const double direct = b[0] + b[1] * water + b[2] * std::exp(5.73 * zenith - 5) + b[3] * state.brightness;
    return {std::max(direct, 0.0) * m.direct_normal, std::max(diffuse, 0.0) * m.diffuse_horizontal};
}

Irradiances irradiances_of(const Illuminances& wanted, const Irradiances& other) {
    Irradiances m = other;
    m.direct_normal = wanted.direct_normal / 100, m.diffuse_horizontal = wanted.diffuse_horizontal / 120;
    for (int round = 0; round < 20; ++round) {  // efficacies hardly change with what they multiply
        const Illuminances now = illuminances_of(m);
        if (now.direct_normal > 0) m.direct_normal *= wanted.direct_normal / now.direct_normal;
        if (now.diffuse_horizontal > 0) m.diffuse_horizontal *= wanted.diffuse_horizontal / now.diffuse_horizontal;
    }
    return m;
}

}  // namespace lw
