// The all-weather sky of Perez: shape and light from what weather stations measure, irradiances in W/m2.
#pragma once
#include "daylight/sky_shape.h"

namespace lw {

/// What is measured, and where the sun stands.
struct Irradiances {
    double direct_normal = 0, diffuse_horizontal = 0;  // W/m2
    double sun_zenith = 0;                             // radians
    double sun_distance = 1;                           // astronomical units
    double dew_point = 10.97;  // degrees Celsius; by default that of 2 cm of water in the air above, a mean
};

/// The two numbers that say what sky it is (Perez et al. 1990, equations 1 and 2).
struct SkyState {
    double clearness = 1;   // epsilon, 1 for overcast to 12
    double brightness = 0;  // delta
};

SkyState sky_state(const Irradiances& measured);

/// The spread of the sky's luminance (Perez, Seals & Michalsky 1993, table 1 and equations 5 to 8). `sun_zenith` in
/// radians.
SkyShape perez_sky(const SkyState& state, double sun_zenith);

/// Lux for the irradiances (Perez et al. 1990, table 4 and equations 6 to 8).
struct Illuminances {
    double direct_normal = 0, diffuse_horizontal = 0;
};

Illuminances illuminances_of(const Irradiances& measured);

/// The irradiances whose illuminances_of() are these, with sun and dew point of `other`.
Irradiances irradiances_of(const Illuminances& wanted, const Irradiances& other);

}  // namespace lw
