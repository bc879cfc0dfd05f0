// Encoders of the packed records whose decoders are in shaders/photon_map.h.
#pragma once
#include "shaders/photon_map.h"

namespace lw {

/// RGB9E5, rounded to nearest; negative and NaN become 0, too large is clamped (Vulkan 1.3 specification, 'RGB to
/// shared exponent').
uint pack_rgb9e5(vec3 color);

/// Octahedral map in 16 + 16 bits of a unit vector.
uint pack_direction(vec3 direction);

}  // namespace lw
