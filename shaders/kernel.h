// The kernel of all density estimates, shared by C++ and GLSL: Epanechnikov's, K(d) = 2 / (pi r^2) (1 - d^2 / r^2)
// within the bandwidth r (Silverman 1986, section 4.2.1). This is the only place that knows the kernel.
#ifndef LW_KERNEL_H
#define LW_KERNEL_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

/// K over its value at the centre; `part` is d^2 / r^2, below 1.
LW_INLINE float kernel_shape(float part) { return 1.0f - part; }

/// K at the centre is this over the area of the disc, so that the integral of K over the disc is 1.
LW_CONST float kernel_height = 2.0f;

/// K at the centre, 1/m2; `r2` is r^2.
LW_INLINE float kernel_peak(float r2) { return kernel_height / (lw_pi * r2); }

/// Integral of kernel_shape() over the triangle of the kernel's centre and the points 0 and t of a line that passes it
/// at distance p, all of it within r; signed as p t.
LW_INLINE float kernel_shape_over_triangle(float p, float t, float r2) {
    return p * t * (0.5f - (p * p + t * t / 3.0f) / (4.0f * r2));
}

#ifdef __cplusplus
}  // namespace lw
#endif
#endif
