// Coverage in closed form, where a lattice lies on plane ground: a few triangles in its plane that do not overlap, at
// most walls across it, and nothing that could bury it. Most of a room is like that; the rest is sampled (coverage.h).
#pragma once
#include <array>
#include <vector>

#include "maps/lattice.h"
#include "trace/ray_caster.h"

namespace lw {

using CoverageLevels = std::array<float, coverage_levels>;

/// Integral of the kernels of all levels (shaders/kernel.h) around the origin over a convex polygon whose
/// corners follow each other to the left; radii[i] is that of level i, ascending, m. 1 each when the polygon covers the
/// largest.
CoverageLevels integrate_kernels(const std::vector<vec2>& polygon, const CoverageLevels& radii);

/// The coverage of the nodes of map m where it has a closed form; the others are left alone and listed in `others`, as
/// indices from the first node of the map. coverage[i]: node i of the map.
void find_flat_coverage(const Scene& scene, const RayCaster& caster, const PhotonMap& map, size_t m,
                        const PatchShape& shape, const NodePoint* nodes, CoverageLevels* coverage,
                        std::vector<uint>& others);

/// The radii of the levels of a map, m.
CoverageLevels radii_of_levels(const SurfaceGrid& grid);

}  // namespace lw
