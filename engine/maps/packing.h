// Encoders of the packed records whose decoders are in shaders/photon_map.h.
#pragma once
#include <cstdint>

#include "shaders/photon_map.h"

namespace lw {

/// Packs a colour to RGB9E5, rounded to nearest. Negative values and NaN become 0, too large ones are clamped (Vulkan
/// 1.3 specification, 'RGB to shared exponent').
uint pack_rgb9e5(vec3 color);

/// Packs a unit vector into 8 + 8 bits of an octahedral map. `dither`, uniform in [0, 1) x [0, 1), chooses one of the
/// four codes around the vector so that the mean over dithers is the vector.
uint16_t pack_direction(vec3 direction, vec2 dither);

}  // namespace lw
