// How far the surroundings of a surface are, and the scale that follows.
#include "maps/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmark/lab_scene.h"

namespace lw {
namespace {

std::vector<LookOut> points_in_rows(vec3 corner, vec3 normal) {
    std::vector<LookOut> points;
    for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 8; ++z)
            points.push_back({corner + vec3(0.25f * float(x), 0, 0.25f * float(z)), normal, 1e-5f});
    return points;
}

/// From a plane at a distance d of an endless one, a ray at angle t goes d / cos t; the mean of cos t / d by the cosine
/// is 2 / (3 d).
TEST(LookAround, OfAPlaneAreAtThreeHalvesOfItsDistance) {
    LabScene lab;
    lab.add_rectangle("ceiling", vec3(-1000, 2, -1000), vec3(2000, 0, 0), vec3(0, 0, 2000), 0.5f);
    lab.add_rectangle("floor", vec3(-1, 0, -1), vec3(0, 0, 2), vec3(2, 0, 0), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    const Surroundings around = look_around(caster, points_in_rows(vec3(-1, 0, -1), vec3(0, 1, 0)), 16, 1);
    EXPECT_NEAR(around.distance, 3, 0.1);
    EXPECT_EQ(around.missed, 0);
    EXPECT_LT(around.spread, 1.5f);
    const Surroundings below = look_around(caster, points_in_rows(vec3(-1, 0, -1), vec3(0, -1, 0)), 16, 1);
    EXPECT_EQ(below.missed, 1);
    EXPECT_GT(below.distance, 1e20f);
}

TEST(LookAround, OfAFewCoveredPointsHardlyCount) {
    LabScene lab;
    lab.add_rectangle("ceiling", vec3(-1000, 2, -1000), vec3(2000, 0, 0), vec3(0, 0, 2000), 0.5f);
    lab.add_rectangle("board", vec3(-1.1f, 0.001f, -1.1f), vec3(0.3f, 0, 0), vec3(0, 0, 3), 0.5f);  // on 8 of 64 points
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    const Surroundings around = look_around(caster, points_in_rows(vec3(-1, 0, -1), vec3(0, 1, 0)), 16, 1);
    EXPECT_LT(around.distance, 3);
    EXPECT_GT(around.distance, 2);
}

TEST(LookAround, GiveTheScaleBetweenItsLimits) {
    LabScene large, small;
    large.add_room(vec3(0), vec3(4, 3, 5), 0.5f);
    small.add_room(vec3(0), vec3(4e-3f, 3e-3f, 5e-3f), 0.5f);
    const ScaleRule rule(large.finish()), of_small(small.finish());
    EXPECT_EQ(rule.least(), 0.25f);
    EXPECT_EQ(rule.scale_of(0), 0.25f);
    EXPECT_EQ(rule.scale_of(2), 0.25f);
    EXPECT_EQ(rule.scale_of(2.5f), 0.5f);
    EXPECT_EQ(rule.scale_of(1e30f), 16);
    EXPECT_EQ(rule.at_most(16, 5), 2);
    EXPECT_EQ(rule.at_most(0.25f, 5), 0.25f);
    EXPECT_EQ(of_small.scale_of(2e-3f), 0.25f / 1024);
}

TEST(LookAround, SeedsFollowFromPlacesAlone) {
    const std::vector<vec3> places{vec3(1, 2, 3), vec3(4, 5, 6)}, others{vec3(1, 2, 3), vec3(4, 5, 7)};
    const std::vector<vec3> moved{vec3(1 - 0.7f, 2, 3 + 0.1f), vec3(4 - 0.7f, 5, 6 + 0.1f)};
    const glm::dvec3 origin(0), other(0.7, 0, -0.1);
    EXPECT_EQ(seed_of(origin, places), seed_of(other, moved));
    EXPECT_NE(seed_of(origin, places), seed_of(origin, others));
    EXPECT_NE(seed_of(origin, places), seed_of(other, places));
}

}  // namespace
}  // namespace lw
