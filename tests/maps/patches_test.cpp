// Which triangles share a map: each side of each in one patch, of one object, one sheet and like orientation.
#include "maps/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "benchmark/lab_scene.h"
#include "benchmark/rooms.h"

namespace lw {
namespace {

constexpr float patch_size = 1;  // m

const Scene& furnished_room() {
    static const Scene room = make_room({10'000, 2});
    return room;
}

std::array<vec3, 3> corners_of(const Scene& scene, size_t triangle) {
    const uvec3 c = scene.triangles[triangle];
    return {scene.positions[c.x], scene.positions[c.y], scene.positions[c.z]};
}

vec3 normal_of(const Scene& scene, size_t side) {
    const auto [a, b, c] = corners_of(scene, side / 2);
    return normalize(cross(b - a, c - a)) * (side % 2 ? -1.0f : 1.0f);
}

/// Adds a floor of cells x cells squares of `size` m at a height to the last object of a scene.
void add_floor(LabScene& lab, float height, int cells, float size) {
    for (int x = 0; x < cells; ++x)
        for (int z = 0; z < cells; ++z)
            lab.add_rectangle("floor", vec3(float(x) * size, height, float(z) * size), vec3(0, 0, size),
                              vec3(size, 0, 0), 0.5f);
}

/// All triangles in one object.
Scene as_one_object(Scene scene) {
    std::fill(scene.triangle_objects.begin(), scene.triangle_objects.end(), 0u);
    return scene;
}

size_t patches_of_front_sides(const Scene& scene, float size) {
    const Patches patches = group_triangles(scene, size);
    std::set<uint> fronts;
    for (size_t side = 0; side < patches.of_side.size(); side += 2) fronts.insert(patches.of_side[side]);
    return fronts.size();
}

TEST(Patches, HoldEverySideOfEveryTriangleAndNoneIsEmpty) {
    const Scene& scene = furnished_room();
    const Patches patches = group_triangles(scene, patch_size);
    ASSERT_EQ(patches.of_side.size(), 2 * scene.triangles.size());
    std::vector<uint> sides(patches.count, 0);
    for (size_t side = 0; side < patches.of_side.size(); ++side) {
        ASSERT_LT(patches.of_side[side], patches.count);
        EXPECT_EQ(patches.at(side, corners_of(scene, side / 2)[0]), patches.of_side[side]);
        ++sides[patches.of_side[side]];
    }
    EXPECT_EQ(std::count(sides.begin(), sides.end(), 0u), 0);
    EXPECT_LT(patches.count, scene.triangles.size());
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    for (uint p = 0; p < patches.count; ++p) EXPECT_EQ(shapes[p].triangles, sides[p]) << p;
}

TEST(Patches, AreOfOneObjectAndOneSide) {
    const Scene& scene = furnished_room();
    const Patches patches = group_triangles(scene, patch_size);
    std::vector<uint> objects(patches.count, ~0u);
    for (size_t side = 0; side < patches.of_side.size(); ++side) {
        uint& object = objects[patches.of_side[side]];
        if (object == ~0u) object = scene.triangle_objects[side / 2];
        EXPECT_EQ(object, scene.triangle_objects[side / 2]) << side;
        EXPECT_NE(patches.of_side[side], patches.of_side[side ^ 1u]) << side;
    }
}

TEST(Patches, FaceOneWayToWithinABin) {
    const Scene& scene = furnished_room();
    const Patches patches = group_triangles(scene, patch_size);
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    for (size_t side = 0; side < patches.of_side.size(); ++side) {
        const PatchShape& shape = shapes[patches.of_side[side]];
        const float cosine = dot(normal_of(scene, side), shape.normal);
        EXPECT_GE(cosine, shape.cos_spread - 1e-5f) << side;
        EXPECT_GT(cosine, std::cos(glm::radians(45.0f))) << side;  // a bin is a ninth of a face of the cube
    }
}

TEST(Patches, AreBoundByTheirBoxesWhoseFramesAreOrthonormal) {
    const Scene& scene = furnished_room();
    const Patches patches = group_triangles(scene, patch_size);
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    const auto within = [](vec3 p, vec3 low, vec3 high) {
        for (int c = 0; c < 3; ++c)
            if (p[c] < low[c] - 1e-5f || p[c] > high[c] + 1e-5f) return false;
        return true;
    };
    for (size_t side = 0; side < patches.of_side.size(); ++side)
        for (const vec3& corner : corners_of(scene, side / 2)) {
            const PatchShape& shape = shapes[patches.of_side[side]];
            EXPECT_TRUE(within(shape.to_local(corner), shape.low, shape.high)) << side;
            EXPECT_TRUE(within(corner, shape.box_low, shape.box_high)) << side;
        }
    for (const PatchShape& shape : shapes) {
        EXPECT_NEAR(length(shape.u_axis), 1, 1e-5);
        EXPECT_NEAR(dot(shape.u_axis, shape.normal), 0, 1e-5);
        EXPECT_LT(length(cross(shape.normal, shape.u_axis) - shape.v_axis), 1e-5);
    }
}

TEST(Patches, OfLargeTrianglesAreOneTriangleAndOthersNoLargerThanTwoCells) {
    const Scene& scene = furnished_room();
    const Patches patches = group_triangles(scene, patch_size);
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    size_t large = 0, shared = 0;
    for (size_t side = 0; side < patches.of_side.size(); ++side) {
        const auto [a, b, c] = corners_of(scene, side / 2);
        const vec3 size = max(a, max(b, c)) - min(a, min(b, c));
        const PatchShape& shape = shapes[patches.of_side[side]];
        const vec3 box = shape.box_high - shape.box_low;
        if (std::max({size.x, size.y, size.z}) > patch_size) {
            EXPECT_EQ(shape.triangles, 1u) << side;
            ++large;
        } else {
            EXPECT_LT(std::max({box.x, box.y, box.z}), 2 * patch_size) << side;
            shared += shape.triangles > 1;
        }
    }
    EXPECT_GT(large, 10u);
    EXPECT_GT(shared, 1000u);
}

TEST(Patches, AreAsFewHoweverFineTheFloorIsDivided) {
    for (int cells : {20, 40, 80}) {
        LabScene lab;
        add_floor(lab, 0, cells, 4.0f / float(cells));
        const size_t patches = patches_of_front_sides(as_one_object(lab.finish()), patch_size);
        EXPECT_TRUE(patches >= 16 && patches <= 25) << patches << " of " << cells << " x " << cells;  // 4 x 4 m
    }
}

TEST(Patches, TilesThatAreObjectsOfTheirOwnShareNone) {
    LabScene lab;
    add_floor(lab, 0, 4, 0.1f);
    const Scene tiles = lab.finish();
    EXPECT_EQ(patches_of_front_sides(tiles, 8), 16u);
    EXPECT_EQ(patches_of_front_sides(as_one_object(tiles), 8), 1u);
}

TEST(Patches, TheBoardsOfAShelfHaveOneEach) {
    const auto patches_of_boards = [](float apart) {
        LabScene lab;
        for (int board = 0; board < 3; ++board) add_floor(lab, apart * float(board), 4, 0.1f);
        return patches_of_front_sides(as_one_object(lab.finish()), 8);
    };
    EXPECT_EQ(patches_of_boards(0.3f), 3u);
    EXPECT_EQ(patches_of_boards(0.001f), 1u);
}

TEST(Patches, LongNeedlesShareOne) {
    LabScene lab;
    for (int i = 0; i < 20; ++i)
        lab.add_rectangle("needle", vec3(0, 0, 0.001f * float(i)), vec3(0, 0, 0.001f), vec3(3, 0, 0), 0.5f);
    EXPECT_EQ(patches_of_front_sides(as_one_object(lab.finish()), patch_size), 1u);
}

TEST(Patches, TrianglesWithoutAreaHaveOneToo) {
    Scene scene = furnished_room();
    for (size_t t = 0; t < 100; ++t) scene.triangles[t].z = scene.triangles[t].y;
    const Patches patches = group_triangles(scene, patch_size);
    for (uint patch : patches.of_side) ASSERT_LT(patch, patches.count);
    for (const PatchShape& shape : shapes_of(scene, patches)) {
        EXPECT_NEAR(length(shape.normal), 1, 1e-5);
        EXPECT_NEAR(length(shape.u_axis), 1, 1e-5);
        EXPECT_NEAR(dot(shape.u_axis, shape.normal), 0, 1e-5);
    }
}

}  // namespace
}  // namespace lw
