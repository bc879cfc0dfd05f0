// FLIP, the difference a person sees when flipping between two pictures on a screen.
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images", the LDR metric with the paper's constants. In: display-linear Rec.709 RGB in [0, 1]. Out: [0, 1] per pixel.
#pragma once
#include <vector>

#include "types.h"

namespace lw {

/// A 4K screen 0.7 m wide seen from 0.7 m.
constexpr float flip_pixels_per_degree = 67.0206f;

/// FLIP of each of width x height pixels; 0 where nobody sees a difference. Both pictures are row-major, values finite.
/// Pixels beyond the border repeat the border.
std::vector<float> flip(const std::vector<vec3>& test, const std::vector<vec3>& reference, int width, int height,
                        float pixels_per_degree = flip_pixels_per_degree);

}  // namespace lw
