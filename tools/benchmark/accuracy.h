// Errors of a frame against the path tracer: over the whole picture, and near the borders of surfaces.
#pragma once
#include <filesystem>

#include "bake_case.h"
#include "image/image.h"

namespace lw {

struct ReferenceView {
    Camera camera;
    uint width, height;
    uint64_t samples;  // paths per pixel
    bool illuminance = true;
};

/// The reference picture of a view with illuminance and standard errors; read from `folder` when it was made before
/// with the same scene, view, samples and seed, otherwise rendered and written there.
Image cached_reference(const std::filesystem::path& folder, const Scene& scene, const RayCaster& caster,
                       const ReferenceView& view);

/// Per pixel: whether the visible point lies within `reach` metres of a border of its surface. Sixteen directions in
/// the tangent plane are tried 1 cm above the point: a border is where one meets something within `reach` (a contact
/// or an inner edge), or where 3 cm below the tangent plane at its end there is no surface, or one turned by more than
/// 60 degrees (an outer edge).
std::vector<bool> border_pixels(const Scene& scene, const RayCaster& caster, const ReferenceView& view,
                                float reach = 0.1f);

/// Per pixel: whether the visible point is on a surface whose illuminance is gathered: not a mirror, which keeps no
/// photons, and not glass, which the gather looks through and the path tracer's illuminance does not.
std::vector<bool> gathered_pixels(const Scene& scene, const RayCaster& caster, const ReferenceView& view);

/// All relative to the mean of the reference.
struct FrameError {
    double rmse = 0;                // as measured, with the noise of the reference in it
    double rmse_without_noise = 0;  // that noise subtracted in quadrature
    double reference_error = 0;     // root mean square standard error of the reference
    double bias = 0;                // mean ratio - 1
    double border_bias = 0;         // the same over border pixels; NaN without any
    double border_share = 0;        // of all pixels that see a surface
    double flip = 0;                // mean FLIP of the tone-mapped colours; NaN when the picture has illuminance only
};

/// Which plane is compared: lux at the surface, or the luminance of the picture (cd/m2).
enum class Quantity { illuminance, luminance };

/// `measured` leaves pixels out of everything but FLIP; empty: none.
FrameError error_of(const Image& picture, const Image& reference, Quantity quantity,
                    const std::vector<bool>& border = {}, const std::vector<bool>& measured = {});

/// Appends rmse, rmse_without_noise, reference_error, bias, border_bias and flip, in percent but for FLIP.
void add_error(Row& row, const FrameError& error);

}  // namespace lw
