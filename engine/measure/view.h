// Pictures for a report: the plan under a grid, and what a camera sees in false colours of illuminance.
#pragma once
#include "image/rgb8_image.h"
#include "measure/survey.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw {

/// A plan: the scene cut at the plane of a grid and seen along -facing, to `band` m beyond the grid's edges on each
/// side, `width` pixels wide. The column of the first sensor is on the left, rows go downwards. Solids that the plane
/// cuts are dark.
Rgb8Image plan_view(const Scene& scene, const RayCaster& caster, const SensorSet& grid, float band, int width);

/// The illuminance at what each pixel of a camera shows, from photons and shadow rays: width x height values in lux,
/// row by row, 0 where the pixel shows nothing.
std::vector<double> seen_illuminance(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                     const Camera& camera, const AmbianceFactors& ambiance, int width, int height);

/// The lowest and highest lux of the colour scale for such a picture: without the darkest and the brightest hundredth
/// of the pixels that show something, and three decades wide at most.
std::pair<double, double> range_of_picture(std::vector<double> lux);

}  // namespace lw
