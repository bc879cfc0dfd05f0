// Coverage in closed form, for nodes on plane ground: a few triangles in one plane that do not overlap, with at most
// walls across them and nothing that could bury them. Most nodes of a room are like that; the others are sampled
// (coverage.h).
#pragma once
#include <array>
#include <vector>

#include "maps/nodes.h"
#include "trace/ray_caster.h"

namespace lw {

/// What the coverage of nodes follows from; all of it must outlive the search.
struct CoverageInput {
    const Scene& scene;
    const RayCaster& caster;
    const Partition& partition;
    const Nodes& nodes;
};

using CoverageLevels = std::array<float, coverage_levels>;

/// Integral of the kernels of all levels (shaders/kernel.h) around the origin over a convex polygon whose
/// corners follow each other to the left; radii[i] is that of level i, ascending, m. 1 each when the polygon covers the
/// largest.
CoverageLevels integrate_kernels(const std::vector<vec2>& polygon, const CoverageLevels& radii);

/// The coverage of the nodes of grid m where it has a closed form: coverage[i] is that of its node i. The others are
/// left alone; their indices, from the first node of the grid, are returned.
std::vector<uint> find_flat_coverage(const CoverageInput& input, size_t m, CoverageLevels* coverage);

/// The radii of the levels of a grid, m.
CoverageLevels radii_of_levels(const SurfaceGrid& grid);

}  // namespace lw
