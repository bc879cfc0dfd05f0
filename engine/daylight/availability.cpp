#include "daylight/availability.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lw {
namespace {

constexpr double radian = 3.14159265358979323846 / 180;

/// IES, "Recommended practice for the calculation of daylight availability", J. IES 13:4 (1984), table 1: the sky gives
/// constant + slope sin^power h, the sun 127,500 lx exp(-extinction / sin h).
struct Availability {
    double constant, slope, power;  // lx
    double extinction;              // negative: no sun is seen
    double kelvin;
};

constexpr std::array<Availability, 3> table{{
    {300, 21'000, 1, -1, 6500},       // D65 is the mean of daylight (CIE 15)
    {300, 45'000, 1, 0.80, 8000},     // between the other two
    {800, 15'500, 0.5, 0.21, 12'000}  // blue sky has 10,000 K and more (Chain, Dumortier & Fontoynont 1999)
}};

}  // namespace

Cover cover_of_cie_sky(int type) {
    return type <= 5 ? Cover::overcast : type <= 10 ? Cover::partly_cloudy : Cover::clear;
}

Cover cover_of_clearness(double clearness) {
    return clearness < 1.23 ? Cover::overcast : clearness < 4.5 ? Cover::partly_cloudy : Cover::clear;
}

double mean_diffuse(Cover cover, double altitude) {
    const Availability& a = table[size_t(cover)];
    return altitude < 0 ? 0 : a.constant + a.slope * std::pow(std::sin(altitude * radian), a.power);
}

double mean_direct(Cover cover, double altitude, double distance) {
    constexpr double outside = 127'500;  // lx
    const Availability& a = table[size_t(cover)];
    if (altitude <= 0 || a.extinction < 0) return 0;
    return outside / (distance * distance) * std::exp(-a.extinction / std::sin(altitude * radian));
}

double sky_temperature(Cover cover) { return table[size_t(cover)].kelvin; }

double sun_temperature(double altitude) {
    // By Wien's law, air that dims 450 nm more than 650 nm by exp(-m t) adds m t / (c2 (1 / 450 nm - 1 / 650 nm)) to
    // 1 / T. t is 0.176 by the molecules of air (Leckner 1978) and 0.054 by clear haze (Angstrom, beta 0.05,
    // alpha 1.3).
    constexpr double outside = 5772, thicker_in_blue = 0.230, lowest = 2000;
    constexpr double wien = 0.014388 * (1 / 450e-9 - 1 / 650e-9);  // K
    const double degrees = std::clamp(altitude, 0.0, 90.0);
    const double mass = 1 / (std::sin(degrees * radian) + 0.15 * std::pow(3.885 + degrees, -1.253));  // Kasten 1965
    return std::max(lowest, 1 / (1 / outside + mass * thicker_in_blue / wien));
}

}  // namespace lw
