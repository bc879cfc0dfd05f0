// Pictures for a report: the plan under a grid, and what a camera sees in false colours of illuminance.
#pragma once
#include "image/rgb8_image.h"
#include "measure/survey.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw {

/// The scene cut at the plane of a grid and seen along -facing, `band` metres beyond its edges on each side; the first
/// sensor's column on the left, rows downwards. What the cut goes through is dark.
Rgb8Image plan_view(const Scene& scene, const RayCaster& caster, const SensorSet& grid, float band, int width);

/// Illuminance of what a camera sees, row by row in lux, 0 where it sees nothing: from the photons and shadow rays.
std::vector<double> seen_illuminance(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                     const Camera& camera, const AmbianceFactors& ambiance, int width, int height);

/// Bounds of the colours of such a picture, lx: all it shows but the darkest and the brightest hundredth, three decades
/// at most; places where nothing is seen do not count.
std::pair<double, double> range_of_picture(std::vector<double> lux);

}  // namespace lw
