// What adapts automatically: exposure and range of the false colours to the picture, the resolution in motion to the
// frame time.
#pragma once
#include "app/session/session.h"

namespace lw {

constexpr double wanted_frame_ms = 66;

/// Moves exposure and range of the false colours towards those that fit the readback. `seconds`: since the last call.
void adapt_to(Viewing& viewing, const std::vector<ReadbackPixel>& readback, float seconds);

/// The range (low, high) of false colours for these values: the 2nd to the 98th percentile, rounded to 1, 2 or 5 times
/// a power of ten. A linear range ends at 3.5 times the median at most (for signed views the 90th percentile), so that
/// a patch of sun does not make the rest of the room dark. For signed views the range is symmetric around 0.
vec2 range_of(std::vector<float> values, uint view, bool logarithmic);

/// Median and 95th percentile of the values of a readback; nothing when no pixel shows a surface.
std::optional<vec2> spread_of(const std::vector<ReadbackPixel>& readback);

/// Chooses the divisor of the picture's width and height in motion, so that a frame takes about wanted_frame_ms. It
/// grows when a frame takes a quarter longer. It shrinks only while the view is still, so that the resolution does not
/// flicker.
class DynamicResolution {
  public:
    static constexpr uint max_divisor = 4;

    /// The divisor of the next frame. `wanted`: the user's choice, 0 for automatic. `last`: times of the last frame.
    /// `still`: the view does not change, and samples add up.
    uint next(uint wanted, const RendererTimes& last, bool still);

  private:
    uint now_ = max_divisor;
    double fixed_ms_ = 0,
           light_ms_ = 1e9;  // of a frame at full resolution: all that does not depend on the pixels; the gather
};

}  // namespace lw
