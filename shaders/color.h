// Luminance and other scalars of a linear RGB colour, shared by C++ and GLSL.
#ifndef LW_COLOR_H
#define LW_COLOR_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

/// The weights of red, green and blue in luminance, Rec. 709.
LW_CONST vec3 luminance_weights = vec3(0.2126f, 0.7152f, 0.0722f);

/// The luminance-weighted sum of the channels: radiance gives cd/m2, irradiance lux, flux lm.
LW_INLINE float luminance(vec3 rgb) { return dot(rgb, luminance_weights); }

/// The largest of the channels.
LW_INLINE float largest(vec3 rgb) { return max(rgb.x, max(rgb.y, rgb.z)); }

#ifdef __cplusplus
/// luminance() in double precision, for sums of many paths.
inline double precise_luminance(vec3 rgb) {
    return 0.2126 * double(rgb.x) + 0.7152 * double(rgb.y) + 0.0722 * double(rgb.z);
}
}  // namespace lw
#endif
#endif
