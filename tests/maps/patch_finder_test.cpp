// Which patches refer to a photon, one photon at a time: on small scenes where the answer is plain, and in a furnished
// room against the rule by brute force.
#include "maps/patch_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/outline.h"
#include "maps/photons_on_floor.h"
#include "maps/places_in_room.h"
#include "maps/wall_lines.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.5f;  // m

/// The patches of a scene, and those that refer to single photons on it.
struct Searched {
    explicit Searched(Scene made) : scene(std::move(made)) {}

    /// The patches that refer to a photon straight below a point, and whether its own is among them.
    std::vector<uint> holders_below(vec3 from) const {
        const std::vector<Photon> photons{*photon_below(caster, from, 0)};
        const PatchFinder finder({scene, caster, partition, photons});
        std::vector<NeighbourReference> found;
        std::vector<uint> holders;
        if (finder.find(0, finder.own_patch(0), found)) holders.push_back(finder.own_patch(0));
        for (const NeighbourReference& reference : found) holders.push_back(reference.patch);
        return holders;
    }
    bool holds(uint triangle, bool front, vec3 from) const {
        const std::vector<uint> holders = holders_below(from);
        const uint patch = partition.patches.of_side[2 * triangle + (front ? 0 : 1)];
        return std::find(holders.begin(), holders.end(), patch) != holders.end();
    }

    Scene scene;
    RayCaster caster{scene};
    Partition partition = partition_surfaces(scene, caster, {.radius = radius});
};

/// A floor of 8 x 8 m in triangles 0 and 1, and a slope that rises at x = 8 by an angle, in triangles 2 and 3.
Searched floor_and_slope(float angle_deg) {
    const float angle = glm::radians(angle_deg);
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 8), vec3(8, 0, 0), 0.5f);
    lab.add_rectangle("slope", vec3(8, 0, 0), vec3(0, 0, 8), 8.0f * vec3(std::cos(angle), std::sin(angle), 0), 0.5f);
    return Searched(lab.finish());
}

TEST(PatchFinder, NeighboursHoldAPhotonAcrossAnEdgeToTheRadiusAndTheAngle) {
    const auto slope_holds = [](const Searched& s, float distance) {
        return s.holds(2, true, vec3(8 - distance, 1, 6)) || s.holds(3, true, vec3(8 - distance, 1, 6));
    };
    for (const float angle : {-59.0f, -30.0f, 0.0f, 30.0f, 59.0f}) {
        const Searched s = floor_and_slope(angle);
        EXPECT_TRUE(slope_holds(s, 0.98f * radius)) << angle;
        EXPECT_FALSE(slope_holds(s, 1.02f * radius)) << angle;
    }
    for (const float angle : {61.0f, 90.0f}) EXPECT_FALSE(slope_holds(floor_and_slope(angle), 0.1f)) << angle;
}

TEST(PatchFinder, OnlySidesThatFaceTheSameWayHoldAPhoton) {
    const Searched s = floor_and_slope(0);
    for (uint triangle = 0; triangle < 4; ++triangle)
        EXPECT_FALSE(s.holds(triangle, false, vec3(7.9f, 1, 7.85f))) << triangle;
    EXPECT_TRUE(s.holds(0, true, vec3(7.9f, 1, 7.85f)));  // on either side of the floor's diagonal
    EXPECT_TRUE(s.holds(1, true, vec3(7.9f, 1, 7.85f)));
}

TEST(PatchFinder, AParallelSheetDoesNotHoldAPhotonUnlessItLiesOnTheSurface) {
    for (const float height : {0.9f * 0.01f * radius, 0.1f * radius}) {
        LabScene lab;
        lab.add_rectangle("floor", vec3(0), vec3(0, 0, 8), vec3(8, 0, 0), 0.5f);
        lab.add_rectangle("table", vec3(2, height, 2), vec3(0, 0, 4), vec3(4, 0, 0), 0.5f);
        const Searched s(lab.finish());
        const bool holds = s.holds(0, true, vec3(3, 1, 5)) || s.holds(1, true, vec3(3, 1, 5));
        EXPECT_EQ(holds, height < 0.01f * radius) << height;
    }
}

/// A hall whose floor, in one plane, is two rectangles that meet at x = 4, with a wall between but for z > 6.
Searched hall_with_a_door() {
    LabScene lab;
    lab.add_rectangle("west", vec3(0), vec3(0, 0, 8), vec3(4, 0, 0), 0.5f);
    lab.add_rectangle("east", vec3(4, 0, 0), vec3(0, 0, 8), vec3(4, 0, 0), 0.5f);
    lab.add_rectangle("wall", vec3(4, 0, 0), vec3(0, 3, 0), vec3(0, 0, 6), 0.5f);
    return Searched(lab.finish());
}

TEST(PatchFinder, LooksThroughDoorsAndNotThroughWalls) {
    const Searched s = hall_with_a_door();
    const auto east_holds = [&](float z) {
        return s.holds(2, true, vec3(3.9f, 1, z)) || s.holds(3, true, vec3(3.9f, 1, z));
    };
    for (const float z : {1.0f, 3.0f, 5.0f}) EXPECT_FALSE(east_holds(z)) << z;
    for (const float z : {6.5f, 7.5f}) EXPECT_TRUE(east_holds(z)) << z;
}

TEST(PatchFinder, APhotonBesideARoundWallStaysOnItsSideOfIt) {
    constexpr int sides = 96;
    constexpr float wall = 1.5f;  // m, radius of the round wall
    const vec2 centre(4, 5);
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 8), vec3(10, 0, 0), 0.5f);
    const auto on_circle = [&](float turn, float r) {
        const float angle = 2 * lw_pi * turn;
        return vec3(centre.x + r * std::cos(angle), 0, centre.y + r * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) {
        const vec3 from = on_circle(float(i) / sides, wall), to = on_circle(float(i + 1) / sides, wall);
        lab.add_rectangle("wall", from, to - from, vec3(0, 2.5f, 0), 0.5f);
    }
    const Searched s(lab.finish());
    size_t held = 0, wrong = 0;
    for (int i = 0; i < 500; ++i)
        for (const float beside : {-0.008f, -0.004f, 0.004f, 0.008f}) {
            const std::vector<uint> holders = s.holders_below(on_circle(float(i) / 500, wall + beside) + vec3(0, 1, 0));
            EXPECT_FALSE(holders.empty());
            for (uint patch : holders) {
                const PatchShape& shape = s.partition.shapes[patch];
                vec2 middle(0);
                for (vec2 p : shape.outline) middle += p / float(shape.outline.size());
                const vec3 at = shape.to_scene(vec3(middle, 0));
                const float outside = length(vec2(at.x, at.z) - centre) - wall;
                if (std::abs(outside) < 2 * width_of_chords(radius)) continue;  // a sliver along the wall
                wrong += (outside > 0) != (beside > 0);
                ++held;
            }
        }
    EXPECT_GT(held, 800u);
    EXPECT_LT(wrong, held / 20);  // in the sharp corners of pieces the way to their inside runs along the wall
}

TEST(PatchFinder, FindsAllAndOnlyThePatchesOfTheRuleInAFurnishedRoom) {
    const RoomPatches& room = furnished_room();
    const RayCaster caster(room.scene);
    const std::vector<Photon> photons = places_in(room, 3'000);
    const PatchFinder finder({room.scene, caster, room.partition, photons});
    size_t present = 0, absent = 0;
    for (uint i = 0; i < photons.size(); ++i) {
        const uint own = finder.own_patch(i);
        const PatchShape& shape = room.partition.shapes.at(own);
        const vec3 local = shape.to_local(photons[i].position);
        if (!shape.outline.empty()) {
            EXPECT_LT(length(nearest_in_outline(shape.outline, vec2(local)) - vec2(local)), 1e-4f);
        }
        std::vector<NeighbourReference> found;
        finder.find(i, own, found);
        std::vector<char> holds(room.partition.patches.count, 0);
        for (const NeighbourReference& reference : found) {
            EXPECT_EQ(reference.photon, i);
            EXPECT_FALSE(holds.at(reference.patch)) << "twice";
            holds[reference.patch] = 1;
        }
        EXPECT_FALSE(holds[own]);
        for (uint patch = 0; patch < holds.size(); ++patch) {
            if (patch == own) continue;
            const Belonging belonging = belonging_of(room, photons[i], patch);
            const bool may_be_hidden = dot(shape.normal, room.partition.shapes[patch].normal) > 0.99f;  // by a wall
            if (belonging == Belonging::no) {
                EXPECT_FALSE(holds[patch]) << patch << " " << i;
                ++absent;
            } else if (belonging == Belonging::sure && !may_be_hidden) {
                EXPECT_TRUE(holds[patch]) << patch << " " << i;
                ++present;
            }
        }
    }
    EXPECT_GT(present, 500u);
    EXPECT_GT(absent, 100'000u);
}

}  // namespace
}  // namespace lw
