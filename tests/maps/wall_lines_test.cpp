// Walls on a floor: found where they stand, as long as they are; what is thin or short is none.
#include "maps/wall_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/lab_scene.h"
#include "maps/cuts.h"

namespace lw {
namespace {

constexpr float radius = 0.5f;  // m

/// A floor of 10 x 8 m in two triangles.
LabScene floor_of_hall() {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 8), vec3(10, 0, 0), 0.5f);
    return lab;
}

/// A wall of no thickness from one point of the floor (x, z) to another.
void add_wall(LabScene& lab, vec2 from, vec2 to, float bottom, float height) {
    lab.add_rectangle("wall", vec3(from.x, bottom, from.y), vec3(to.x - from.x, 0, to.y - from.y), vec3(0, height, 0),
                      0.5f);
}

/// A line on the floor in the axes of the scene, and how far along it walls stand.
struct Found {
    vec2 from, to;  // x and z of the first and the last stretch's ends
    bool is_chord;
};

/// The lines on the upper side of the floor, whose sides are the first two triangles; each is found on both.
std::vector<Found> lines_on_floor(LabScene& lab) {
    const Scene scene = lab.finish();
    const Patches patches = group_triangles(scene, 6 * radius);
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    std::vector<Found> found;
    for (const WalledPatch& walled : find_walls(scene, std::vector<float>(shapes.size(), radius), shapes)) {
        const PatchShape& shape = shapes[walled.patch];
        if (shape.triangle > 1 || shape.normal.y < 0.9f) continue;
        for (const WallLine& line : walled.lines) {
            const auto place = [&](float at) {
                const vec2 local = line.point + line.along * at;
                const vec3 p = shape.anchor + shape.u_axis * local.x + shape.v_axis * local.y;
                return vec2(p.x, p.z);
            };
            found.push_back({place(line.stretches.front().x), place(line.stretches.back().y), line.is_chord});
        }
    }
    return found;
}

float distance_to_line(vec2 p, vec2 a, vec2 b) {
    const vec2 along = normalize(b - a);
    return std::abs(along.x * (p.y - a.y) - along.y * (p.x - a.x));
}

TEST(WallLines, AStraightWallIsFoundWhereItStands) {
    for (const vec2 to : {vec2(7, 2), vec2(2, 6), vec2(6, 5)}) {  // at any angle
        LabScene lab = floor_of_hall();
        const vec2 from(2, 2);
        add_wall(lab, from, to, 0, 2.5f);
        const std::vector<Found> lines = lines_on_floor(lab);
        ASSERT_FALSE(lines.empty());
        float first = 1e30f, last = -1e30f;
        for (const Found& line : lines) {
            EXPECT_FALSE(line.is_chord);
            for (vec2 end : {line.from, line.to}) {
                EXPECT_LT(distance_to_line(end, from, to), 0.002f);
                const float at = dot(end - from, normalize(to - from));
                first = std::min(first, at), last = std::max(last, at);
            }
        }
        EXPECT_LT(first, 0.01f);
        EXPECT_GT(last, length(to - from) - 0.01f);
    }
}

TEST(WallLines, AnOpeningPartsTheStretchesOfOneLine) {
    LabScene lab = floor_of_hall();
    add_wall(lab, {1, 0.5f}, {3, 0.5f}, 0, 2.5f);  // over one triangle of the floor
    add_wall(lab, {4, 0.5f}, {6, 0.5f}, 0, 2.5f);
    const Scene scene = lab.finish();
    const Patches patches = group_triangles(scene, 6 * radius);
    const std::vector<PatchShape> shapes = shapes_of(scene, patches);
    float longest = 0, sum = 0;
    for (const WalledPatch& walled : find_walls(scene, std::vector<float>(shapes.size(), radius), shapes)) {
        if (shapes[walled.patch].triangle > 1 || shapes[walled.patch].normal.y < 0.9f) continue;
        for (const WallLine& line : walled.lines) {
            longest = std::max(longest, line.length);
            float stretches = 0;
            for (vec2 s : line.stretches) stretches += s.y - s.x;
            sum = std::max(sum, stretches);
        }
    }
    EXPECT_NEAR(longest, 2, 0.01f);
    EXPECT_NEAR(sum, 4, 0.02f);
}

TEST(WallLines, WhatIsThinShortOrAboveTheFloorIsNoWall) {
    const auto count = [](vec2 to, float bottom, float height) {
        LabScene lab = floor_of_hall();
        add_wall(lab, {2, 2}, to, bottom, height);
        return lines_on_floor(lab).size();
    };
    const float thin = 0.9f * height_of_cuts(radius);
    EXPECT_EQ(count({7, 2}, 0, thin), 0u);                              // a rug
    EXPECT_EQ(count({2 + 0.9f * radius, 2}, 0, 1), 0u);                 // a leg of a table
    EXPECT_EQ(count({7, 2}, 1.2f * height_of_cuts(radius), 2.5f), 0u);  // light passes below
    EXPECT_GT(count({7, 2}, 0, 1.2f * height_of_cuts(radius)), 0u);     // a threshold
    EXPECT_GT(count({2 + 1.1f * radius, 2}, 0, 1), 0u);
}

TEST(WallLines, WhatLeansMoreThanItStandsIsNoWall) {
    const auto count = [](float lean_deg) {
        LabScene lab = floor_of_hall();
        const float angle = glm::radians(lean_deg);
        lab.add_rectangle("board", vec3(2, 0, 2), vec3(5, 0, 0), vec3(0, std::cos(angle), std::sin(angle)), 0.5f);
        return lines_on_floor(lab).size();
    };
    EXPECT_GT(count(0), 0u);
    EXPECT_GT(count(40), 0u);
    EXPECT_EQ(count(50), 0u);
}

TEST(WallLines, ARoundWallIsKeptCloseToByItsChords) {
    LabScene lab = floor_of_hall();
    constexpr int sides = 96;
    const vec2 centre(4, 5);
    const auto on_wall = [&](int i) {
        const float angle = 2 * lw_pi * float(i) / sides;
        return centre + 1.5f * vec2(std::cos(angle), std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) add_wall(lab, on_wall(i), on_wall(i + 1), 0, 2.5f);
    const std::vector<Found> lines = lines_on_floor(lab);
    float chords = 0;
    for (const Found& line : lines) {
        EXPECT_TRUE(line.is_chord);
        chords += length(line.to - line.from);
        for (int k = 0; k <= 10; ++k) {
            const vec2 p = line.from + (line.to - line.from) * (float(k) / 10);
            EXPECT_NEAR(length(p - centre), 1.5f, width_of_chords(radius) + 0.001f);
        }
    }
    EXPECT_GT(chords, 0.8f * 2 * lw_pi * 1.5f);
}

}  // namespace
}  // namespace lw
