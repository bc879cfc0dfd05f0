// Convex outlines: hulls, and points in and around them.
#include "maps/outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace lw {
namespace {

const Outline rectangle{{0, 0}, {2, 0}, {2, 1}, {0, 1}};

float height_over(vec2 a, vec2 b, vec2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

TEST(Outline, TheNearestPointIsThePointItselfInsideAndOnTheRimOutside) {
    EXPECT_EQ(nearest_in_outline(rectangle, {1.5f, 0.5f}), vec2(1.5f, 0.5f));
    EXPECT_EQ(nearest_in_outline(rectangle, {3, 0.5f}), vec2(2, 0.5f));
    EXPECT_EQ(nearest_in_outline(rectangle, {-1, -2}), vec2(0, 0));
}

TEST(Outline, PointsNearTheRimMoveInwards) {
    EXPECT_EQ(inside_outline(rectangle, {1, 0.5f}, 0.2f), vec2(1, 0.5f));
    EXPECT_LT(length(inside_outline(rectangle, {1.95f, 0.02f}, 0.2f) - vec2(1.8f, 0.2f)), 1e-6f);
}

TEST(Outline, PointsInASharpCornerMoveInwardsFromBothSides) {
    const Outline corner{{0, 0}, {8, 0}, {8, 4}};
    const vec2 inside = inside_outline(corner, {0.01f, 0}, 0.2f), along(2 / std::sqrt(5.0f), 1 / std::sqrt(5.0f));
    EXPECT_NEAR(inside.y, 0.2f, 0.004f);
    EXPECT_NEAR(along.y * inside.x - along.x * inside.y, 0.2f, 0.004f);
}

TEST(Outline, PartsHaveNoEdgesWithoutADirection) {
    const Outline whole{{0, 0}, {4, 0}, {4, 2.5f}};
    const Outline part = part_of(whole, {4 - 1e-6f, 2.5f}, {-4, 2.5f - 1e-6f});  // through a corner, but for rounding
    ASSERT_EQ(part.size(), 3u);
    for (size_t i = 0; i < part.size(); ++i) EXPECT_GT(length(part[(i + 1) % part.size()] - part[i]), 0.1f) << i;
}

TEST(Outline, AHullIsConvexCounterClockwiseAndHoldsAllPoints) {
    for (uint64_t i = 0; i < 200; ++i) {
        Rng rng(1, 1, i);
        std::vector<vec2> points(3 + size_t(30 * rng.next()));
        for (vec2& p : points) p = {rng.next(), 2 * rng.next()};
        const Outline hull = hull_of(points);
        ASSERT_GE(hull.size(), 3u);
        for (size_t k = 0; k < hull.size(); ++k) {
            const vec2 a = hull[k], b = hull[(k + 1) % hull.size()];
            EXPECT_GT(height_over(a, b, hull[(k + 2) % hull.size()]), 0);
            for (vec2 q : points) EXPECT_GE(height_over(a, b, q), -1e-6f);
        }
    }
}

}  // namespace
}  // namespace lw
