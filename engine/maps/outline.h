// Convex outlines of pieces of patches, in the plane of their patch.
#pragma once
#include <vector>

#include "shaders/types.h"

namespace lw {

/// The corners of a convex polygon, counter-clockwise, m.
using Outline = std::vector<vec2>;

/// The convex hull of points (monotone chain, Andrew 1979).
Outline hull_of(Outline points);

/// The point of a convex outline nearest to `p`: itself when it lies inside.
vec2 nearest_in_outline(const Outline& outline, vec2 p);

/// `p` moved inwards until no side of a convex outline is closer than `distance`, if it is as wide as that.
vec2 inside_outline(const Outline& outline, vec2 p, float distance);

/// The part of a convex outline on the left of the line through `point` along `along`, without edges so short that they
/// have no direction.
Outline part_of(const Outline& outline, vec2 point, vec2 along);

/// Its area, m2.
float area_of(const Outline& outline);

}  // namespace lw
