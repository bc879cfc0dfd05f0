// Colours of lamps as catalogues write them.
#pragma once
#include <string>

namespace lw {

/// Kelvin of a text: a temperature ("3000", "2700K"), a code of three digits whose last two are hundreds of kelvin and
/// whose first is a group of colour rendering ("830", "840/4000K", "TL5 965"), or a class of EN 12464-1 by its English
/// or German name or letters (warm or ww 3000, neutral or nw 4000, cool, daylight, cw, dw or tw 6500); 0 for others.
double temperature_of(const std::string& text);

}  // namespace lw
