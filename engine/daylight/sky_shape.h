// How the luminance of a sky is spread over the hemisphere: the 15 general skies of the CIE (CIE S 011 / ISO
// 15469:2004) and the sky of Perez, Seals & Michalsky (1993), which have one form.
#pragma once

namespace lw {

/// The luminance of a place of the sky is proportional to (1 + a exp(b / cos Z)) (floor + c exp(d X) + e cos^2 X), with
/// Z its angle to the zenith and X its angle to the sun, radians.
struct SkyShape {
    double a = 0, b = -1;                    // from the horizon to the zenith
    double floor = 1, c = 0, d = -1, e = 0;  // around the sun
    bool needs_sun() const { return c != 0 || e != 0; }
};

/// Sky `type` of the CIE, 1 to 15: 1 is overcast, 5 uniform, 12 clear.
SkyShape cie_sky(int type);

/// The unscaled luminance at cos Z above the horizon and cos X.
double value_of(const SkyShape& shape, double cos_zenith, double cos_sun);

/// The illuminance of an open horizontal plane under the unscaled sky, with the sun at an angle to the zenith, radians.
double horizontal_value(const SkyShape& shape, double sun_zenith);

/// Luminance of the zenith, cd/m2, for each lux of diffuse horizontal illuminance.
double zenith_ratio(const SkyShape& shape, double sun_zenith);

}  // namespace lw
