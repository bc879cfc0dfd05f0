// Where the sun stands, from place and time. Written after Meeus, Astronomical Algorithms (2nd edition, 1998) with the
// largest terms of the theory VSOP87 (Bretagnon & Francou 1988); within 0.001 degrees from 1950 to 2050.
#pragma once

namespace lw {

/// A place on the earth, degrees: north and east are positive.
struct Place {
    double latitude = 0, longitude = 0;
};

/// The direction to the middle of the sun.
struct SunPosition {
    double altitude = 0;  // degrees above the horizon
    double azimuth = 0;   // degrees from north, clockwise seen from above, 0 to 360
    double distance = 1;  // from the earth, astronomical units
};

/// The sun as it would stand without air, seen from the ground. `julian_day` is in universal time.
SunPosition sun_position(const Place& place, double julian_day);

/// The air that bends the light.
struct Air {
    double pressure = 1010;   // mbar
    double temperature = 10;  // degrees Celsius
};

/// Degrees by which the air lifts a body that stands at `altitude` degrees (Meeus, equation 16.4); 0 for one that is
/// below the horizon all the same.
double refraction(double altitude, const Air& air = {});

/// sun_position() with the refraction() of mean air: where the light comes from.
SunPosition apparent_sun_position(const Place& place, double julian_day);

}  // namespace lw
