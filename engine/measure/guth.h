// Position index of Guth: how much less a bright thing glares beside the line of sight than in it.
#pragma once
#include "shaders/types.h"

namespace lw {

/// Of a unit direction for eyes that look along `forward`: 1 in the line of sight, growing away from it. The table of
/// CIE 117:1995 between its T/R (sideways) and H/R (upwards), linear; below the line of sight that of the same angle
/// sideways (Iwata & Osterhaus 2010). Infinite outside the table and behind the eyes: no glare.
double position_index(vec3 direction, vec3 forward, vec3 up);

}  // namespace lw
