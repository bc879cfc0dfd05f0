// The surfaces of a scene parted into patches: all of them, each once, with radii that follow from the patches' sizes.
#include "maps/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/lab_scene.h"
#include "maps/places_in_room.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.25f;  // m, of furnished_room()

PatchShape rectangle(float width, float depth) {
    PatchShape shape;
    shape.low = vec3(-1, 2, 0), shape.high = vec3(width - 1, depth + 2, 0);
    return shape;
}

float radius_of(float width, float depth, float largest = 100, float floor = 0) {
    return patch_radii({rectangle(width, depth)}, {largest}, floor).at(0);
}

/// How far the surroundings of a rectangle, to a distance of r, outnumber it, in squares and quarters of a disc.
double overhang(double width, double depth, double r) {
    const double strips = 2 * width * r + 2 * depth * r, quarters = 4 * (M_PI * r * r / 4);
    return (strips + quarters) / (width * depth);
}

TEST(Partition, CoversEverySideOfEveryTriangleOnce) {
    const RoomPatches& room = furnished_room();
    const Partition& partition = room.partition;
    ASSERT_EQ(partition.patches.of_side.size(), 2 * room.scene.triangles.size());
    ASSERT_EQ(partition.shapes.size(), partition.patches.count);
    ASSERT_EQ(partition.radii.size(), partition.patches.count);
    std::vector<uint> sides(partition.patches.count, 0);
    for (uint id : partition.patches.of_side)
        if (!is_cut(id)) ++sides.at(id);
    std::vector<uint> led_to(partition.patches.count, 0);
    for (const Cut& cut : partition.patches.cuts)
        for (uint id : {cut.front, cut.back})
            if (!is_cut(id)) ++led_to.at(id);
    for (size_t p = 0; p < sides.size(); ++p) {
        const bool is_piece = !partition.shapes[p].outline.empty();
        EXPECT_EQ(led_to[p], is_piece ? 1u : 0u) << p;
        EXPECT_EQ(sides[p], is_piece ? 0u : partition.shapes[p].triangles) << p;
    }
}

TEST(Partition, EveryPointLiesInTheBoxOfItsPatch) {
    const RoomPatches& room = furnished_room();
    for (const Photon& place : places_in(room, 5'000)) {
        const uint patch = room.partition.patches.at(2 * place.triangle + place.side(), place.position);
        const PatchShape& shape = room.partition.shapes.at(patch);
        const vec3 local = shape.to_local(place.position);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(local[c], shape.low[c] - 1e-4f) << patch;
            EXPECT_LE(local[c], shape.high[c] + 1e-4f) << patch;
        }
    }
}

TEST(Partition, TrianglesShareAPatchUpToSixRadii) {
    for (const float size : {5.9f * radius, 6.1f * radius}) {
        LabScene lab;
        lab.add_rectangle("floor", vec3(0), vec3(0, 0, size), vec3(size, 0, 0), 0.5f);
        const Scene scene = lab.finish();
        const Partition partition = partition_surfaces(scene, RayCaster(scene), {.radius = radius});
        EXPECT_EQ(partition.patches.count, size < 6 * radius ? 2u : 4u) << size;
    }
}

TEST(Partition, IsCutWhereAWallStandsAndKeepsItsSettings) {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 6), vec3(6, 0, 0), 0.5f);
    lab.add_rectangle("wall", vec3(3, 0, 0), vec3(0, 3, 0), vec3(0, 0, 6), 0.5f);
    const Scene scene = lab.finish();
    const Partition partition =
        partition_surfaces(scene, RayCaster(scene), {.radius = radius, .neighbour_angle_deg = 40});
    EXPECT_EQ(partition.scales, std::vector<float>(partition.patches.count, radius));
    EXPECT_EQ(partition.neighbour_angle_deg, 40);
    for (const float z : {0.5f, 2.5f}) {  // of the second triangle of the floor
        const size_t front = 2;
        ASSERT_TRUE(is_cut(partition.patches.of_side[front]));
        EXPECT_NE(partition.patches.at(front, vec3(2.99f, 0, z)), partition.patches.at(front, vec3(3.01f, 0, z)));
        EXPECT_EQ(partition.patches.at(front, vec3(3.01f, 0, z)), partition.patches.at(front, vec3(5.9f, 0, z)));
    }
}

TEST(Partition, RadiiOfSmallPatchesAreLessButAtLeastHalf) {
    const Partition& partition = furnished_room().partition;
    const auto [least, most] = std::minmax_element(partition.radii.begin(), partition.radii.end());
    EXPECT_EQ(*most, radius);
    EXPECT_EQ(*least, 0.5f * radius);
    for (size_t p = 0; p < partition.radii.size(); ++p) {
        if (partition.radii[p] <= 0.5f * radius) continue;
        const vec3 size = partition.shapes[p].high - partition.shapes[p].low;
        EXPECT_LE(overhang(double(size.x), double(size.y), double(partition.radii[p])), 1.1001) << p;
    }
}

TEST(PatchRadii, HoldTheSurroundingsToElevenTenthsOfThePatch) {
    EXPECT_NEAR(overhang(2, 3, double(radius_of(2, 3))), 1.1, 1e-5);
    EXPECT_NEAR(overhang(5, 0.2, double(radius_of(5, 0.2f))), 1.1, 1e-4);
}

TEST(PatchRadii, LieBetweenFloorAndLargest) {
    EXPECT_EQ(radius_of(2, 3, 0.1f), 0.1f);
    EXPECT_EQ(radius_of(0.01f, 3, 1, 0.5f), 0.5f);
    EXPECT_EQ(radius_of(0, 0, 1, 0.5f), 0.5f);
    EXPECT_EQ(radius_of(0.01f, 3, 0.4f, 0.5f), 0.2f);
    EXPECT_TRUE(patch_radii({}, {}, 0.5f).empty());
}

}  // namespace
}  // namespace lw
