// How far a picture is from its reference: bias, RMSE, relMSE, FLIP. In: two pictures of one size with channels R, G, B
// in cd/m2, or one channel that both have, e.g. "illuminance" in lux. RMSE, relMSE and the ratio are of luminance
// (Rec.709) or of that channel; FLIP is of exposed, tone-mapped colour.
#pragma once
#include <string>

#include "image/image.h"
#include "image/rgb8_image.h"

namespace lw {

struct Comparison {
    double mean_ratio = 0;          // mean of the picture / mean of the reference; 1 is unbiased
    double bias = 0;                // mean_ratio - 1
    double rmse_relative = 0;       // root of the mean squared difference / mean of the reference
    double rel_mse = 0;             // mean of (a - r)^2 / (r^2 + (0.1 mean r)^2)
    double flip = 0;                // mean FLIP, 0 to 1 (image/flip.h)
    double p95_relative_error = 0;  // 95th percentile of |a - r| / max(r, 0.01 mean r), both blurred by an 8x8 box
    double reference_mean = 0;      // cd/m2, or the channel's unit
    float exposure_ev = 0;  // EV100 at which both pictures were exposed for FLIP: auto_exposure_ev() of the reference
};

/// Compares `picture` with `reference`. An empty `channel` means R, G, B.
/// Throws Error when the sizes differ, a channel is missing, a value is not finite (naming channel and pixel),
/// or the reference is black on average.
Comparison compare(const Image& picture, const Image& reference, const std::string& channel = "");

/// Signed relative difference as a picture: red where `picture` is too bright, blue where too dark, black where equal,
/// full colour from 20 % of max(r, 0.05 mean r) up. Throws like compare.
Rgb8Image difference_picture(const Image& picture, const Image& reference, const std::string& channel = "");

}  // namespace lw
