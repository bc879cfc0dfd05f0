// From a picture in cd/m2 to one for a screen: exposure, tone curve, sRGB codes of 8 bits.
// The curve and its sources are in shaders/tonemap.glsl, which the GPU pass shares. EV is EV100, as on a light meter:
// exposed value = luminance / (1.2 * 2^EV), so one EV more is half as bright. A lit room has EV 5 to 8.
#pragma once
#include "image/image.h"
#include "image/rgb8_image.h"
#include "shaders/color.h"
#include "tonemap.glsl"

namespace lw {

/// The channels R, G, B of each pixel; throws Error naming the first one that is missing.
std::vector<vec3> rgb_pixels(const Image& image);

/// Exposed and tone-mapped RGB, display-linear in [0, 1]. Negative values count as 0, NaN stays NaN.
vec3 tone_map_pixel(const vec3& rgb_cd_m2, float exposure_ev);

/// Channels R, G, B in cd/m2 to sRGB codes. A pixel that is not a number becomes magenta, to be seen.
/// Throws Error when a channel is missing.
Rgb8Image tonemap(const Image& image, float exposure_ev);

/// The EV that puts the log-average luminance of the picture's 5th to 95th percentile at 0.2 on the screen, but puts
/// the 90th percentile at 1.2 or below: windows and lamps may be clipped to white, the room may not. Returns 0 for a
/// black picture.
float auto_exposure_ev(const Image& image);
/// The same from the luminances of a sample of the picture's pixels, cd/m2.
float auto_exposure_ev(std::vector<float> luminances);

}  // namespace lw
