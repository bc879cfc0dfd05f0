#include "daylight/solar_position.h"

#include <cmath>
#include <span>

namespace lw {
namespace {

constexpr double radian = 3.14159265358979323846 / 180;  // of a degree

/// A cosine of the theory VSOP87: amplitude x cos(phase + frequency t), t in millennia from 2000.
struct Term {
    double amplitude, phase, frequency;
};

// The longitude of the earth, in 1e-8 radians, by powers of t (Meeus, appendix III).
constexpr Term longitude_0[] = {
    {175347046, 0, 0},
    {3341656, 4.6692568, 6283.0758500},
    {34894, 4.62610, 12566.15170},
    {3497, 2.7441, 5753.3849},
    {3418, 2.8289, 3.5231},
    {3136, 3.6277, 77713.7715},
    {2676, 4.4181, 7860.4194},
    {2343, 6.1352, 3930.2097},
    {1324, 0.7425, 11506.7698},
    {1273, 2.0371, 529.6910},
    {1199, 1.1096, 1577.3435},
    {990, 5.233, 5884.927},
    {902, 2.045, 26.298},
    {857, 3.508, 398.149},
    {780, 1.179, 5223.694},
    {753, 2.533, 5507.553},
    {505, 4.583, 18849.228},
    {492, 4.205, 775.523},
    {357, 2.920, 0.067},
    {317, 5.849, 11790.629},
    {284, 1.899, 796.298},
    {271, 0.315, 10977.079},
    {243, 0.345, 5486.778},
    {206, 4.806, 2544.314},
    {205, 1.869, 5573.143},
    {202, 2.458, 6069.777},
};
constexpr Term longitude_1[] = {
    {628331966747, 0, 0}, {206059, 2.678235, 6283.075850}, {4303, 2.6351, 12566.1517}, {425, 1.590, 3.523},
    {119, 5.796, 26.298}, {109, 2.966, 1577.344},
};
constexpr Term longitude_2[] = {{52919, 0, 0}, {8720, 1.0721, 6283.0758}, {309, 0.867, 12566.152}};

// The distance of the earth, in 1e-8 astronomical units.
constexpr Term distance_0[] = {{100013989, 0, 0},
                               {1670700, 3.0984635, 6283.0758500},
                               {13956, 3.05525, 12566.15170},
                               {3084, 5.1985, 77713.7715},
                               {1628, 1.1739, 5753.3849},
                               {1576, 2.8469, 7860.4194},
                               {925, 5.453, 11506.770},
                               {542, 4.564, 3930.210},
                               {472, 3.661, 5884.927},
                               {346, 0.964, 5507.553},
                               {329, 5.900, 5223.694}};
constexpr Term distance_1[] = {{103019, 1.107490, 6283.075850}};

double sum_of(std::span<const Term> terms, double millennia) {
    double sum = 0;
    for (const Term& term : terms) sum += term.amplitude * std::cos(term.phase + term.frequency * millennia);
    return sum * 1e-8;
}

/// Seconds by which the uniform time of the theory is ahead of universal time (Espenak & Meeus 2006, for 2005 to 2050;
/// half a minute off in 1950, which moves the sun by 0.0003 degrees).
double delta_t(double julian_day) {
    const double years = (julian_day - 2451545) / 365.25;
    return 62.92 + 0.32217 * years + 0.005589 * years * years;
}

/// What the moon does to the axis of the earth, degrees (Meeus, chapter 22, the formulas of lower accuracy).
struct Nutation {
    double longitude, obliquity;
};

Nutation nutation_at(double centuries) {
    const double node = radian * (125.04452 - 1934.136261 * centuries);
    const double sun = radian * (280.4665 + 36000.7698 * centuries);
    const double moon = radian * (218.3165 + 481267.8813 * centuries);
    return {
        (-17.20 * std::sin(node) - 1.32 * std::sin(2 * sun) - 0.23 * std::sin(2 * moon) + 0.21 * std::sin(2 * node)) /
            3600,
        (9.20 * std::cos(node) + 0.57 * std::cos(2 * sun) + 0.10 * std::cos(2 * moon) - 0.09 * std::cos(2 * node)) /
            3600};
}

/// The sun among the stars, radians (Meeus, chapter 25), and what time of the stars it is in Greenwich.
struct Celestial {
    double right_ascension, declination, sidereal_time, distance;
};

Celestial sun_among_stars(double julian_day) {
    const double millennia = (julian_day + delta_t(julian_day) / 86400 - 2451545) / 365250, centuries = 10 * millennia;
    const double earth = sum_of(longitude_0, millennia) +
                         millennia * (sum_of(longitude_1, millennia) + millennia * sum_of(longitude_2, millennia));
    const double distance = sum_of(distance_0, millennia) + millennia * sum_of(distance_1, millennia);
    const Nutation nutation = nutation_at(centuries);
    const double aberration = -20.4898 / 3600 / distance;
    const double longitude = earth + radian * (180 + nutation.longitude + aberration);
    const double obliquity =
        radian * (23.4392911 - 0.0130042 * centuries - 1.64e-7 * centuries * centuries + nutation.obliquity);
    const double days = julian_day - 2451545, t = days / 36525;
    const double sidereal_time = 280.46061837 + 360.98564736629 * days + 0.000387933 * t * t +
                                 nutation.longitude * std::cos(obliquity);  // equation 12.4
    return {std::atan2(std::sin(longitude) * std::cos(obliquity), std::cos(longitude)),
            std::asin(std::sin(obliquity) * std::sin(longitude)), radian * std::fmod(sidereal_time, 360.0), distance};
}

}  // namespace

SunPosition sun_position(const Place& place, double julian_day) {
    const Celestial sun = sun_among_stars(julian_day);
    const double latitude = radian * place.latitude;
    const double hour_angle = sun.sidereal_time + radian * place.longitude - sun.right_ascension;
    // Equations 13.5 and 13.6, with the azimuth from north.
    const double sine = std::sin(latitude) * std::sin(sun.declination) +
                        std::cos(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
    const double azimuth = std::atan2(-std::cos(sun.declination) * std::sin(hour_angle),
                                      std::sin(sun.declination) * std::cos(latitude) -
                                          std::cos(sun.declination) * std::cos(hour_angle) * std::sin(latitude));
    const double altitude = std::asin(std::fmax(-1.0, std::fmin(1.0, sine)));
    const double parallax = 8.794 / 3600 / sun.distance * std::cos(altitude);  // the ground is not the earth's centre
    const double degrees = azimuth / radian;
    return {altitude / radian - parallax, degrees < 0 ? degrees + 360 : degrees, sun.distance};
}

double refraction(double altitude, const Air& air) {
    constexpr double lowest = -0.8333;  // at which the upper edge of the sun is on the horizon
    if (altitude < lowest) return 0;
    const double minutes = 1.02 / std::tan(radian * (altitude + 10.3 / (altitude + 5.11)));
    return minutes / 60 * air.pressure / 1010 * 283 / (273 + air.temperature);
}

SunPosition apparent_sun_position(const Place& place, double julian_day) {
    SunPosition sun = sun_position(place, julian_day);
    sun.altitude += refraction(sun.altitude);
    return sun;
}

}  // namespace lw
