// Coverage at lattice nodes of an open floor: how much of a kernel lies on it follows from its edges. Once of two
// triangles, where it has a closed form, and once of so many that it is sampled.
#include "maps/coverage.h"
#include "maps/buried.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/baked_lab.h"

namespace lw {
namespace {

constexpr float width = 4, radius = 0.5f;  // m

/// A square floor under the sky, of n x n squares of one object; or half of it, one triangle.
test::BakedLab bake_floor(int n, bool is_half = false) {
    LabScene lab;
    const float size = width / float(n);
    for (int x = 0; x < n; ++x)
        for (int z = 0; z < n; ++z)
            lab.add_rectangle("floor", vec3(float(x) * size, 0, float(z) * size), vec3(0, 0, size), vec3(size, 0, 0),
                              0.5f);
    lab.add_point(vec3(0.5f * width, 2, 0.5f * width), 100);
    Scene scene = lab.finish();
    if (is_half) scene.triangles.resize(1), scene.triangle_objects.resize(1);
    std::fill(scene.triangle_objects.begin(), scene.triangle_objects.end(), 0u);
    return {std::move(scene), {.photons = 20'000, .radius = radius, .direct_in_photons = true}};
}

/// The part of the kernel of radius r around a point that lies on the floor, by rings around it.
double expected_at(vec3 p, double r) {
    constexpr int rings = 60, steps = 240;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < steps; ++k) {
            const double t = (i + 0.5) / rings, angle = 2 * M_PI * (k + 0.5) / steps;
            const double x = double(p.x) + r * t * std::cos(angle), z = double(p.z) + r * t * std::sin(angle);
            const bool inside = x >= 0 && x <= double(width) && z >= 0 && z <= double(width);
            sum += inside ? 4 * (1 - t * t) * t / (rings * steps) : 0;
        }
    return sum;
}

struct Errors {
    double mean = 0, worst = 0;
    size_t count = 0, at_edges = 0;
};

/// Of all nodes over the triangles of their map, for the kernel of a level.
Errors errors_of(const test::BakedLab& lab, uint level) {
    std::vector<std::vector<size_t>> triangles(lab.map.grids.size());
    for (size_t side = 0; side < lab.map.grid_of_side.size(); ++side)
        if (const uint m = lab.map.grid_of_side[side]; m != no_grid && !is_cut(m)) triangles[m].push_back(side / 2);
    Errors errors;
    for (size_t m = 0; m < lab.map.grids.size(); ++m) {
        const SurfaceGrid& grid = lab.map.grids[m];
        for (uint i = 0; i < grid.lattice.columns * grid.lattice.rows; ++i) {
            const vec2 cells{float(i % grid.lattice.columns), float(i / grid.lattice.columns)};
            const vec3 p = point_on_lattice(grid, cells, 0);
            const bool is_over = std::any_of(triangles[m].begin(), triangles[m].end(), [&](size_t t) {
                const auto [a, b, c] = lab.corners(t);
                return length(closest_point_on_triangle(p, a, b, c) - p) < 1e-4f;
            });
            if (!is_over) continue;
            const float fraction = float(level + 1) / float(coverage_levels);
            const double expected = expected_at(p, double(fraction * grid.radius));
            const double error =
                double(unpack_coverage(lab.map.coverage[grid.lattice.first_node + i], fraction)) - expected;
            errors.mean += error, errors.worst = std::max(errors.worst, std::abs(error));
            ++errors.count, errors.at_edges += expected < 0.9;
        }
    }
    errors.mean /= double(std::max<size_t>(errors.count, 1));
    return errors;
}

TEST(Coverage, OfTilesIsThePartOfTheKernelOnTheFloor) {
    const test::BakedLab lab = bake_floor(40);
    const Errors errors = errors_of(lab, coverage_levels - 1);
    EXPECT_GT(errors.count, 100u);
    EXPECT_GT(errors.at_edges, 20u);
    EXPECT_LT(errors.worst, 0.1);  // some 100 samples under a kernel
    EXPECT_NEAR(errors.mean, 0, 0.01);
}

TEST(Coverage, OfATriangleIsOneInTheMiddleHalfAtItsLongEdgeAndAnEighthInItsCorners) {
    const test::BakedLab lab = bake_floor(1, true);
    size_t counts[3] = {};
    test::for_each_node(lab, [&](const test::Node& node) {
        if (length(node.position - node.on_triangle) > 1e-4f) return;
        const uint bits = lab.map.coverage[node.index];
        const float x = node.position.x, z = node.position.z;  // the triangle is where x <= z <= width
        const float to_diagonal = (z - x) / std::sqrt(2.0f), to_edges = std::min(x, width - z);
        const auto expect_all = [&](float expected) {
            for (float fraction : {0.25f, 0.5f, 0.75f, 1.0f})
                EXPECT_NEAR(unpack_coverage(bits, fraction), expected, 0.004) << x << " " << z;
        };
        if (to_diagonal > radius && to_edges > radius) expect_all(1), ++counts[0];
        if (to_diagonal < 1e-4f && to_edges > radius) expect_all(0.5f), ++counts[1];
        if (to_diagonal < 1e-4f && to_edges < 1e-4f) expect_all(0.125f), ++counts[2];  // 45 degrees
    });
    EXPECT_GT(counts[0], 10u);
    EXPECT_GT(counts[1], 10u);
    EXPECT_EQ(counts[2], 2u);
}

TEST(Coverage, BetweenEdgeAndMiddleIsThePartOfTheKernelOnTheFloorForAllRadii) {
    const test::BakedLab lab = bake_floor(1);
    size_t count = 0;
    test::for_each_node(lab, [&](const test::Node& node) {
        if (length(node.position - node.on_triangle) > 1e-4f) return;
        for (float fraction : {0.25f, 0.5f, 0.75f, 1.0f}) {
            const double expected = expected_at(node.position, double(fraction * radius));
            EXPECT_NEAR(unpack_coverage(lab.map.coverage[node.index], fraction), expected, 0.015);
            ++count;
        }
    });
    EXPECT_GT(count, 200u);
}

}  // namespace
}  // namespace lw
