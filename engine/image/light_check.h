// A check made before a picture is written: light is finite and not negative.
#pragma once
#include "image/image.h"

namespace lw {

/// Throws Error naming channel and pixel when R, G, B or illuminance holds a NaN, an infinity or a negative value.
void check_is_light(const Image& image);

}  // namespace lw
