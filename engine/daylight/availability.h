// How much light sky and sun give on the mean, and of what colour, where nothing was measured.
#pragma once
#include "daylight/sky_shape.h"

namespace lw {

enum class Cover { overcast, partly_cloudy, clear };

/// The cover under which a general sky of the CIE is seen: 1 to 5 overcast, 6 to 10 partly cloudy, 11 to 15 clear (CIE
/// S 011).
Cover cover_of_cie_sky(int type);

/// The cover of a sky of this clearness (perez.h): overcast below 1.23, clear from 4.5 on (Perez et al. 1990, table 1).
Cover cover_of_clearness(double clearness);

/// Diffuse horizontal illuminance, lx, with the sun at `altitude` degrees; 0 when it is below the horizon.
double mean_diffuse(Cover cover, double altitude);

/// Illuminance from the sun on a plane that faces it, lx. `distance` in astronomical units.
double mean_direct(Cover cover, double altitude, double distance);

/// Correlated colour temperature of the whole sky, kelvin.
double sky_temperature(Cover cover);

/// Correlated colour temperature of the sun at `altitude` degrees, kelvin.
double sun_temperature(double altitude);

}  // namespace lw
