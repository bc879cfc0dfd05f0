// What adapts to the picture by itself: exposure, the range of the false colours, the resolution while moving.
#pragma once
#include "app/session/session.h"

namespace lw {

constexpr double wanted_frame_ms = 66;

/// Moves exposure and range towards what the readback asks for, `seconds` after the last time.
void adapt_to(Viewing& viewing, const std::vector<ReadbackPixel>& readback, float seconds);

/// Ends of the false colours that show these values: the 2nd to the 98th percentile, rounded to 1, 2 or 5 times a power
/// of ten; a linear range no further than 3.5 times the median (signed: 90th percentile), so that a patch of sun burns
/// out and the room does not drown; even around 0 for signed views.
vec2 range_of(std::vector<float> values, uint view, bool logarithmic);

/// Median and 95th percentile of the values of a readback; none when nothing is seen.
std::optional<vec2> spread_of(const std::vector<ReadbackPixel>& readback);

/// Chooses by how much the picture's sides are divided while moving, so that a frame takes about 66 ms: coarser when
/// one takes a quarter longer, finer only after standing still, so that nothing flickers between sizes.
class DynamicResolution {
  public:
    static constexpr uint max_divisor = 4;

    /// `wanted`: what the user chose, 0 for automatic. `still`: samples are adding up.
    uint next(uint wanted, const RendererTimes& last, bool still);

  private:
    uint now_ = max_divisor;
    double fixed_ms_ = 0,
           light_ms_ = 1e9;  // of a frame: what does not follow the pixels, and the gather of all of them
};

}  // namespace lw
