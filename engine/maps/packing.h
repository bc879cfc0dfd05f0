// Encoders of the packed records whose decoders are in shaders/photon_map.h.
#pragma once
#include <cstdint>

#include "shaders/photon_map.h"

namespace lw {

/// Octahedral map in 8 + 8 bits of a unit vector: one of the four codes around it, chosen by `dither` in [0, 1) x [0,
/// 1) so that their mean is the vector.
uint16_t pack_direction(vec3 direction, vec2 dither);

}  // namespace lw
