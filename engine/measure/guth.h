// The position index of Guth: how much brighter a source beside the line of sight must be to glare like one in it.
#pragma once
#include "shaders/types.h"

namespace lw {

/// The index of a source in unit `direction`, for eyes that look along unit `forward`: 1 in the line of sight, larger
/// away from it. Interpolated in the table of CIE 117:1995 over T/R (sideways) and H/R (upwards). A source below the
/// line of sight has the index of the same angle sideways (Iwata & Osterhaus 2010). Infinite, so no glare, outside the
/// table and behind the eyes.
double position_index(vec3 direction, vec3 forward, vec3 up);

}  // namespace lw
