// Walls part the patches they stand on: each piece is a patch, the pieces together are the whole, and what lies on one
// side of a wall is never in the patch of the other.
#include "maps/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "maps/baked_lab.h"
#include "maps/outline.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.5f;  // m

/// A hall of 10 x 3 x 8 m with a wall across it at x = 6 but for a door, and a point lamp on either side.
Scene hall() {
    LabScene lab;
    lab.add_room(vec3(0), vec3(10, 3, 8), 0.5f);
    lab.add_rectangle("wall", vec3(6, 0, 0), vec3(0, 3, 0), vec3(0, 0, 6.5f), 0.5f);
    lab.add_point(vec3(3, 2, 4), 300);
    lab.add_point(vec3(8, 2, 4), 100);
    return lab.finish();
}

bool is_floor(const PatchShape& shape) {
    return shape.normal.y > 0.9f && shape.high.z < 0.1f && shape.box_high.y < 0.1f;
}

float area_of(const std::vector<vec2>& outline) {
    float doubled = 0;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
        doubled += p.x * q.y - p.y * q.x;
    }
    return 0.5f * doubled;
}

ScaledPatches cut(const Scene& scene) {
    ScaledPatches scaled;
    scaled.patches = group_triangles(scene, 6 * radius);
    scaled.shapes = shapes_of(scene, scaled.patches);
    scaled.scales.assign(scaled.patches.count, radius);
    cut_patches(scene, scaled);
    return scaled;
}

TEST(Cuts, PiecesTogetherAreTheWhole) {
    const Scene scene = hall();
    const auto [patches, shapes, scales] = cut(scene);
    ASSERT_FALSE(patches.cuts.empty());
    ASSERT_EQ(shapes.size(), patches.count);
    ASSERT_EQ(scales, std::vector<float>(patches.count, radius));
    float floor = 0;
    for (const PatchShape& shape : shapes)
        if (is_floor(shape)) floor += shape.outline.empty() ? 40.0f : area_of(shape.outline);  // uncut: half of it
    EXPECT_NEAR(floor, 80, 0.01);
}

TEST(Cuts, PiecesAreConvexAndLieWithinTheirBoxes) {
    const Scene scene = hall();
    const auto [patches, shapes, scales] = cut(scene);
    for (const PatchShape& shape : shapes)
        for (size_t i = 0; i < shape.outline.size(); ++i) {
            const vec2 p = shape.outline[i], q = shape.outline[(i + 1) % shape.outline.size()],
                       r = shape.outline[(i + 2) % shape.outline.size()];
            EXPECT_GE((q.x - p.x) * (r.y - q.y) - (q.y - p.y) * (r.x - q.x), -1e-4f);
            EXPECT_TRUE(p.x >= shape.low.x && p.x <= shape.high.x && p.y >= shape.low.y && p.y <= shape.high.y);
        }
}

TEST(Cuts, EveryPointLiesInThePieceWhoseOutlineHoldsIt) {
    const Scene scene = hall();
    const auto [patches, shapes, scales] = cut(scene);
    size_t in_pieces = 0;
    for (size_t i = 0; i < 20'000; ++i) {
        Rng rng(1, 1, i);
        const size_t side = size_t(rng.next() * float(patches.of_side.size()));
        const uvec3 c = scene.triangles[side / 2];
        const float root = std::sqrt(rng.next()), part = rng.next();
        const vec3 p = scene.positions[c.x] * (1 - root) + scene.positions[c.y] * (root * (1 - part)) +
                       scene.positions[c.z] * (root * part);
        const uint patch = patches.at(side, p);
        ASSERT_LT(patch, patches.count);
        if (shapes[patch].outline.empty()) continue;
        const vec2 local(shapes[patch].to_local(p));
        EXPECT_LT(length(nearest_in_outline(shapes[patch].outline, local) - local), 1e-4f);
        ++in_pieces;
    }
    EXPECT_GT(in_pieces, 1000u);
}

TEST(Cuts, NoPhotonIsInTheMapOfTheOtherSideOfAWall) {
    const BakedLab lab(hall(), {.photons = 100'000, .radius = radius});
    size_t beside = 0;
    for (size_t m = 0; m < lab.map.grids.size(); ++m) {
        const SurfaceGrid& grid = lab.map.grids[m];
        if (grid.normal.y < 0.9f || grid.origin.y > 0.1f) continue;
        size_t left = 0, right = 0;  // of the wall, far from the door
        const uint first = lab.map.cell_starts[grid.first_cell],
                   last = lab.map.cell_starts[grid.first_cell + grid.columns * grid.rows];
        for (uint i = first; i < last; ++i) {
            const vec3 local = place_in_grid(lab.map.places[i], grid);
            const vec3 p = grid.origin + grid.u_axis * local.x + grid.v_axis * local.y;
            if (p.z > 6.5f - radius || p.z < radius) continue;
            left += p.x < 5.999f && p.x > 6 - radius;
            right += p.x > 6.001f && p.x < 6 + radius;
        }
        EXPECT_TRUE(left == 0 || right == 0) << m << ": " << left << " and " << right;
        beside += left + right;
    }
    EXPECT_GT(beside, 200u);
}

}  // namespace
}  // namespace lw
