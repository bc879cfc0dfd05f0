// Patches whose sizes follow what is around them: small in narrow places, wide in open ones, and the same whatever else
// the scene holds far away.
#include "maps/local_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "benchmark/lab_scene.h"
#include "benchmark/rooms.h"
#include "maps/outline.h"
#include "maps/partition.h"
#include "maps/tiles.h"
#include "scene/triangle.h"

namespace lw {
namespace {

/// What a patch is, without its number.
using Description = std::tuple<float, float, float, float, float, float, float, float, float, float, float>;

Description description_of(const Partition& partition, size_t p) {
    const PatchShape& s = partition.shapes[p];
    return {s.box_low.x, s.box_low.y, s.box_low.z, s.box_high.x,        s.box_high.y,      s.box_high.z,
            s.normal.x,  s.normal.y,  s.normal.z,  partition.scales[p], partition.radii[p]};
}

/// The patches inside a box whose fronts look into it.
std::vector<Description> patches_within(const Partition& partition, vec3 low, vec3 high) {
    std::vector<Description> found;
    for (size_t p = 0; p < partition.shapes.size(); ++p) {
        const PatchShape& s = partition.shapes[p];
        const vec3 to_middle = 0.5f * (low + high) - 0.5f * (s.box_low + s.box_high);
        if (s.box_low.x >= low.x && s.box_low.y >= low.y && s.box_low.z >= low.z && s.box_high.x <= high.x &&
            s.box_high.y <= high.y && s.box_high.z <= high.z && dot(s.normal, to_middle) > 0)
            found.push_back(description_of(partition, p));
    }
    std::sort(found.begin(), found.end());
    return found;
}

Partition partition_of(LabScene& lab) {
    const Scene scene = lab.finish();
    return partition_surfaces(scene, RayCaster(scene), {});
}

LabScene room() {
    LabScene lab;
    lab.add_room(vec3(0), vec3(4, 3, 5), 0.5f);
    lab.add_rectangle("wall", vec3(2, 0, 0), vec3(0, 2, 0), vec3(0, 0, 2), 0.5f);
    for (int x = 0; x < 12; ++x)
        for (int z = 0; z < 12; ++z)
            lab.add_rectangle("table", vec3(2.5f + 0.1f * float(x), 0.7f, 3 + 0.1f * float(z)), vec3(0, 0, 0.1f),
                              vec3(0.1f, 0, 0), 0.5f);
    return lab;
}

TEST(LocalPatches, AreTheSameWithALawnBelowAndAStrayTriangleFarAway) {
    LabScene alone = room(), on_lawn = room(), with_stray = room();
    on_lawn.add_rectangle("lawn", vec3(-300, -0.3f, -300), vec3(0, 0, 600), vec3(600, 0, 0), 0.5f);
    with_stray.add_rectangle("stray", vec3(1000, 500, 1000), vec3(0, 0, 1), vec3(1, 0, 0), 0.5f);
    const vec3 low(-0.1f), high(4.1f, 3.1f, 5.1f);
    const auto expected = patches_within(partition_of(alone), low, high);
    EXPECT_GT(expected.size(), 15u);
    EXPECT_EQ(patches_within(partition_of(on_lawn), low, high), expected);
    EXPECT_EQ(patches_within(partition_of(with_stray), low, high), expected);
}

TEST(LocalPatches, HaveScalesThatFollowTheirSurroundings) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(2, 2, 2), 0.5f);
    lab.add_room(vec3(100, 0, 0), vec3(140, 40, 40), 0.5f);
    const Partition partition = partition_of(lab);
    float small[2] = {1e30f, 0}, large[2] = {1e30f, 0};
    for (size_t p = 0; p < partition.scales.size(); ++p) {
        const PatchShape& s = partition.shapes[p];
        const vec3 middle = s.box_low.x < 50 ? vec3(1) : vec3(120, 20, 20);
        if (dot(s.normal, middle - 0.5f * (s.box_low + s.box_high)) < 0) continue;  // outside
        float* limits = s.box_low.x < 50 ? small : large;
        limits[0] = std::min(limits[0], partition.scales[p]), limits[1] = std::max(limits[1], partition.scales[p]);
    }
    EXPECT_GE(small[0], 0.125f);
    EXPECT_LT(small[1], 0.3f);
    EXPECT_GT(large[0], 1);  // 20 times as wide
    EXPECT_LT(large[1], 6);
}

TEST(LocalPatches, HoldEverySideOnceAndAreNoWiderThanTwelveScales) {
    const Scene scene = make_room({10'000, 2});
    const RayCaster caster(scene);
    const ScaledPatches found = find_local_patches(scene, caster);
    ASSERT_EQ(found.patches.of_side.size(), 2 * scene.triangles.size());
    ASSERT_EQ(found.shapes.size(), found.patches.count);
    ASSERT_EQ(found.scales.size(), found.patches.count);
    std::vector<uint> sides(found.patches.count, 0);
    for (uint id : found.patches.of_side) ++sides.at(id);
    size_t shared = 0;
    for (size_t p = 0; p < sides.size(); ++p) {
        EXPECT_EQ(sides[p], found.shapes[p].triangles) << p;
        if (sides[p] == 1) continue;
        const vec3 size = found.shapes[p].box_high - found.shapes[p].box_low;
        EXPECT_LE(std::max({size.x, size.y, size.z}), 24.01f * found.scales[p])
            << p;  // of centres: twelve, and a triangle
        ++shared;
    }
    EXPECT_GT(shared, 100u);
}

TEST(Tiles, AreSmallAroundWhatStandsOnALawnAndWideFarFromIt) {
    LabScene lab;
    lab.add_rectangle("lawn", vec3(-300, 0, -300), vec3(0, 0, 600), vec3(600, 0, 0), 0.5f);
    lab.add_room(vec3(10, 0.01f, 10), vec3(14, 3, 15), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    ScaledPatches found = find_local_patches(scene, caster);
    cut_into_tiles(scene, caster, found);
    double area = 0;
    size_t tiles = 0;
    for (const PatchShape& shape : found.shapes)
        if (shape.triangle < 2 && shape.normal.y > 0.9f)
            area += shape.outline.empty() ? 0.5 * 360'000 : double(area_of(shape.outline)), ++tiles;
    EXPECT_NEAR(area, 360'000, 10);
    EXPECT_GT(tiles, 10u);
    EXPECT_LT(tiles, 200u);
    const auto width_at = [&](vec3 place) {  // of the narrowest that holds it
        float width = 1e30f;
        for (const PatchShape& s : found.shapes) {
            const vec3 local = s.to_local(place);
            const bool holds = local.x >= s.low.x && local.x <= s.high.x && local.y >= s.low.y && local.y <= s.high.y;
            if (s.triangle < 2 && s.normal.y > 0.9f && holds)
                width = std::min(width, std::max(s.high.x - s.low.x, s.high.y - s.low.y));
        }
        return width;
    };
    EXPECT_LT(width_at(vec3(9, 0, 12)), 10);
    EXPECT_GT(width_at(vec3(200, 0, -200)), 50);
}

TEST(Tiles, AreNoneOfAnOpenLawnAndOfAPlainRoom) {
    LabScene lab;
    lab.add_rectangle("lawn", vec3(-300, 0, -300), vec3(0, 0, 600), vec3(600, 0, 0), 0.5f);
    lab.add_room(vec3(10, 1000, 10), vec3(40, 1004, 50), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    ScaledPatches found = find_local_patches(scene, caster);
    cut_into_tiles(scene, caster, found);
    size_t inside = 0;
    for (const PatchShape& s : found.shapes)
        inside += !s.outline.empty() && std::abs(s.normal.y) > 0.9f &&
                  dot(s.normal, vec3(25, 1002, 30) - 0.5f * (s.box_low + s.box_high)) > 0;
    EXPECT_EQ(inside, 0u);
    EXPECT_TRUE(found.shapes[found.patches.of_side[0]].outline.empty());
}

TEST(LowerRadii, FollowTheDensityOfPhotonsDownToWhatLatticesShow) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(4, 4, 4), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    const Partition before = partition_surfaces(scene, caster, {});
    std::vector<Photon> photons;
    for (uint i = 0; i < 10'000; ++i)  // on the front of the first triangle, of 8 m2
        photons.push_back(
            {triangle_corners(scene, 0)[0], vec3(1), vec3(0, 1, 0), 0, pack_origin(0, path_indirect, false)});
    Partition after = before;
    lower_radii(scene, photons, Follow::surroundings, after);
    const uint lit = before.patches.of_side[0];
    const double area = 8 * before.shapes[lit].triangles, dense = std::sqrt(250 * area / (M_PI * 10'000));
    EXPECT_LT(dense, 2 * double(before.node_distances[lit]));
    EXPECT_EQ(after.radii[lit], 2 * before.node_distances[lit]);
    EXPECT_LT(after.radii[lit], before.radii[lit]);
    EXPECT_EQ(after.node_distances, before.node_distances);
    Partition by_photons = before;
    lower_radii(scene, photons, Follow::photons, by_photons);
    EXPECT_NEAR(by_photons.radii[lit], dense, 1e-5);
    EXPECT_NEAR(by_photons.node_distances[lit], 0.5 * dense, 1e-5);
    for (size_t p = 0; p < before.radii.size(); ++p) {
        if (p == lit) continue;
        EXPECT_EQ(after.radii[p], before.radii[p]) << p;
        EXPECT_EQ(by_photons.radii[p], before.radii[p]) << p;
    }
}

}  // namespace
}  // namespace lw
