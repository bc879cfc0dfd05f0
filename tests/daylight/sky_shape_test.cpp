// Skies against closed forms, against Radiance, and their division into patches.
#include "daylight/sky_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "daylight/perez.h"
#include "daylight/tregenza.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

/// The integral of m exp(-x / m) over m from 0 to 1: the exponential integral E3.
double e3(double x) { return (std::exp(-x) * (1 - x) + x * x * -std::expint(-x)) / 2; }

TEST(CieSky, OfEvenLuminanceGivesPiTimesIt) { EXPECT_NEAR(zenith_ratio(cie_sky(5), 1), 1 / pi, 2e-5 / pi); }

TEST(CieSky, WithGradationAloneHasAClosedForm) {
    for (const auto& [type, a, b] : {std::tuple(1, 4.0, -0.70), {3, 1.1, -0.8}}) {
        const double horizontal = 2 * pi * (0.5 + a * e3(-b));
        EXPECT_NEAR(zenith_ratio(cie_sky(type), 0.7) * horizontal, 1 + a * std::exp(b), 1e-4);
    }
    // The overcast sky is three times as bright at the zenith as at the horizon.
    EXPECT_NEAR(value_of(cie_sky(1), 1, 0) / value_of(cie_sky(1), 0, 0), 3, 0.02);
}

TEST(CieSky, WithIndicatrixAloneHasAClosedFormUnderAHighSun) {
    struct Case {
        int type;
        double c, d, e;
    };
    for (const Case& s : {Case{6, 2, -1.5, 0.15}, Case{7, 5, -2.5, 0.30}, Case{8, 10, -3.0, 0.45}}) {
        const double at_horizon = std::exp(s.d * pi / 2);
        const double horizontal = pi * (1 - s.c * at_horizon + s.c * (2 * at_horizon + 2) / (s.d * s.d + 4) + s.e / 2);
        EXPECT_NEAR(horizontal_value(cie_sky(s.type), 0) / horizontal, 1, 1e-4) << s.type;
    }
}

TEST(CieSky, IsAsTheStandardDefinesIt) {
    // Table 1 of CIE S 011 and its equations at one place, 40 degrees from the zenith and 25 from the sun.
    constexpr double table[15][5] = {{4, -.7, 0, -1, 0},       {4, -.7, 2, -1.5, .15},  {1.1, -.8, 0, -1, 0},
                                     {1.1, -.8, 2, -1.5, .15}, {0, -1, 0, -1, 0},       {0, -1, 2, -1.5, .15},
                                     {0, -1, 5, -2.5, .3},     {0, -1, 10, -3, .45},    {-1, -.55, 2, -1.5, .15},
                                     {-1, -.55, 5, -2.5, .3},  {-1, -.55, 10, -3, .45}, {-1, -.32, 10, -3, .45},
                                     {-1, -.32, 16, -3, .3},   {-1, -.15, 16, -3, .3},  {-1, -.15, 24, -2.8, .15}};
    const double z = 40 * pi / 180, x = 25 * pi / 180;
    for (int type = 1; type <= 15; ++type) {
        const auto& t = table[type - 1];
        const double phi = 1 + t[0] * std::exp(t[1] / std::cos(z));
        const double f = 1 + t[2] * (std::exp(t[3] * x) - std::exp(t[3] * pi / 2)) + t[4] * std::cos(x) * std::cos(x);
        EXPECT_NEAR(value_of(cie_sky(type), std::cos(z), std::cos(x)), phi * f, 1e-12) << type;
    }
}

/// A sky of each class of clearness and a dim one: what gendaymtx of Radiance 6.0a makes of a line of a weather file
/// (-O0, dew point 11 degrees, sky alone or sun alone).
struct FromRadiance {
    double altitude, azimuth, direct_normal, diffuse_horizontal, eccentricity;  // what is given
    double direct_lux;
    std::array<double, 8> to_zenith;  // luminances of patches over that of the zenith
};
constexpr std::array<int, 8> compared{0, 8, 16, 40, 75, 100, 130, 143};
constexpr FromRadiance radiance_skies[] = {
    {59.9736, 137.8981, 750, 130, 1.01669, 77412, {1.1564, 1.4858, 1.3675, 1.3914, .6311, .54, 2.9433, .6562}},
    {26.1077, 244.8315, 200, 250, 1.00711, 17896, {1.017, 1.0171, 1.6659, .9986, 4.7899, 4.7008, .8721, 1.1293}},
    {64.1193, 197.1372, 880, 80, 1.01711, 91245, {1.4145, 1.2437, 1.7629, .8673, 1.1188, 1.0525, .8816, .8244}},
    {64.3368, 198.3556, 400, 300, 1.01669, 38676, {.4277, .4534, .6443, .5111, .9178, .9853, .864, .8389}},
    {31.3539, 133.9350, 50, 200, .99607, 4632, {1.2382, 2.6886, 1.8945, 5.4913, 1.2339, 1.0121, 1.8673, .8472}},
    {28.5181, 116.9259, 500, 120, 1.00018, 47508, {2.2729, 7.4129, 2.5482, 12.2813, 1.2063, .9881, 1.9706, .8572}},
    {53.8668, 145.6693, 200, 220, 1.00885, 19441, {.7751, 1.1014, 1.1386, 1.5895, .7516, .6456, 2.3589, .6982}},
    {23.1906, 154.0110, 30, 45, .98649, 2703, {2.6773, 3.6759, 5.5498, 5.7875, 2.0744, 1.4549, 1.5704, .9241}},
    {34.0188, 176.6011, 0, 150, 0.99852, 0, {.5645, .6473, .754, .7903, .9154, .9469, 1.018, .9745}}};

TEST(PerezSky, IsThatOfRadiance) {
    const auto patches = tregenza_patches();
    for (const FromRadiance& r : radiance_skies) {
        Irradiances m{r.direct_normal, r.diffuse_horizontal, (90 - r.altitude) * pi / 180, r.eccentricity, 11};
        const SkyShape shape = perez_sky(sky_state(m), m.sun_zenith);
        const auto luminance = [&](const SkyPatch& p) {
            const double a = p.altitude * pi / 180, h = r.altitude * pi / 180;
            return value_of(
                shape, std::sin(a),
                std::sin(a) * std::sin(h) + std::cos(a) * std::cos(h) * std::cos((p.azimuth - r.azimuth) * pi / 180));
        };
        for (size_t i = 0; i < compared.size(); ++i)
            EXPECT_NEAR(luminance(patches[size_t(compared[i])]) / luminance(patches.back()) / r.to_zenith[i], 1, 5e-4)
                << r.altitude << " " << compared[i];
        EXPECT_NEAR(illuminances_of(m).direct_normal, r.direct_lux, 5e-4 * r.direct_lux);
    }
}

TEST(PerezSky, HasTheEfficacyOfItsPaper) {
    // Perez et al. 1990, equation 7 by hand: overcast, epsilon 1, Z 60 degrees, W 2 cm, delta as in equation 2.
    Irradiances m;
    m.diffuse_horizontal = 100, m.sun_zenith = pi / 3, m.dew_point = (std::log(2.0) + 0.075) / 0.07;
    const double mass = 1 / (0.5 + 0.15 * std::pow(93.885 - 60, -1.253)), delta = 100 * mass / 1367;
    EXPECT_NEAR(illuminances_of(m).diffuse_horizontal, 100 * (97.24 - 0.46 * 2 + 12 * 0.5 - 8.91 * std::log(delta)),
                1e-6);
    m.direct_normal = 300;
    const Illuminances lux = illuminances_of(m);
    const Irradiances back = irradiances_of(lux, m);
    EXPECT_NEAR(back.direct_normal, 300, 0.1);
    EXPECT_NEAR(back.diffuse_horizontal, 100, 0.1);
}

TEST(SkyPatches, CoverTheHemisphere) {
    double sum = 0, smallest = 1, largest = 0;
    const auto patches = tregenza_patches();
    for (size_t i = 0; i < patches.size(); ++i) {
        const SkyPatch& p = patches[i];
        sum += p.solid_angle;
        smallest = std::min(smallest, p.solid_angle), largest = std::max(largest, p.solid_angle);
        EXPECT_EQ(patch_at(p.altitude, p.azimuth), int(i));
        EXPECT_EQ(patch_at(p.low + 0.01, p.azimuth + 0.499 * p.width + 360), int(i));
        EXPECT_EQ(patch_at(p.high - 0.01, p.azimuth - 0.499 * p.width), int(i));
    }
    EXPECT_NEAR(sum, 2 * pi, 1e-12);
    EXPECT_GT(smallest, 0.03);
    EXPECT_LT(largest, 0.05);
    EXPECT_EQ(patch_at(-5, 0), 0);
    EXPECT_EQ(patch_at(90, 123), 144);
}

}  // namespace
}  // namespace lw
