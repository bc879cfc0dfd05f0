// Luminance of linear Rec. 709, shared by C++ and GLSL.
#ifndef LW_COLOR_H
#define LW_COLOR_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_INLINE float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f)); }

#ifdef __cplusplus
/// The same for sums that need more digits.
inline double precise_luminance(vec3 rgb) {
    return 0.2126 * double(rgb.x) + 0.7152 * double(rgb.y) + 0.0722 * double(rgb.z);
}
}  // namespace lw
#endif
#endif
