// Rules of shaders/kernel.h and shaders/photon_map.h as factors, in words that compilers turn into vectors.
#pragma once
#include "shaders/kernel.h"

namespace lw {

/// `value` where it is positive, else 0.
inline float positive(float value) { return value > 0 ? value : 0.0f; }

/// kernel_shape() within the kernel, 0 beyond it.
inline float kernel_weight(float part) { return positive(kernel_shape(part)); }

/// on_same_surface() as 1 or 0.
inline float same_surface_weight(float height, float distance_squared, float search_radius) {
    const float above = positive((height < 0 ? -height : height) - 0.01f * search_radius);
    return float(above * above <= 0.75f * distance_squared);
}

}  // namespace lw
