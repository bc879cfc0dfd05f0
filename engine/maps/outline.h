// Convex outlines of pieces of patches, in the plane of their patch.
#pragma once
#include <vector>

#include "shaders/types.h"

namespace lw {

/// The corners of a convex polygon, counter-clockwise, m.
using Outline = std::vector<vec2>;

/// The convex hull of points (monotone chain, Andrew 1979).
Outline hull_of(Outline points);

/// The point of the area inside a convex outline that is nearest to `p`: `p` itself when it lies inside.
vec2 nearest_in_outline(const Outline& outline, vec2 p);

/// `p` moved inwards from every side of a convex outline that is closer than `distance` m, until it is that far from
/// it.
vec2 inside_outline(const Outline& outline, vec2 p, float distance);

}  // namespace lw
