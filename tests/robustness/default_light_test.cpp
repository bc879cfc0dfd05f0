// The light that the programs show by default - direct light exact, by shadow rays or with the shadows of the lattice -
// where it is easily wrong: behind walls of a millimetre, under a sheet, outside a shade, beside a lamp at a wall.
#include <gtest/gtest.h>

#include <cmath>

#include "maps/estimate.h"
#include "robustness/room.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};
constexpr uint shadow_rays[] = {0, 4};
const glm::dvec3 down(0, -1, 0), up(0, 1, 0);

/// A bake as that of the programs, and what is read of it in one way to gather.
struct DefaultLight {
    explicit DefaultLight(const Room& room) : baked(room, 100'000), bvh(build_bvh(baked.scene)) {}

    /// Illuminance where a ray meets a surface, from that side, in lux; -1 where there is none.
    double lux(uint mode, uint rays, glm::dvec3 from, glm::dvec3 direction) const {
        const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, rays}, bvh);
        const std::optional<Hit> hit = baked.caster.nearest(vec3(from - baked.scene.origin), vec3(direction));
        if (!hit) return -1;
        const vec3 light = estimator.estimate(hit->triangle, hit->barycentrics, vec3(-direction)).irradiance;
        return double(luminance(light));
    }

    Baked baked;
    Bvh bvh;
    std::vector<vec3> weights = lamp_powers(baked.scene, {});
};

/// Calls read(mode, shadow rays) for every way.
template <class Read>
void in_every_way(const Read& read) {
    for (uint mode : modes)
        for (uint rays : shadow_rays) {
            SCOPED_TRACE("mode " + std::to_string(mode) + ", shadow rays " + std::to_string(rays));
            read(mode, rays);
        }
}

std::string worded(bool small_triangles) { return small_triangles ? ", small triangles" : ""; }

Room two_rooms(double wall, bool small_triangles) {
    Room room = plain_room();
    room.walls = joined(room.walls, box({4 + wall, 0, 0}, {8, 3, 5}, true));
    if (small_triangles) room.walls = divided(room.walls, 20);
    return room;
}

TEST(DefaultLight, NeverComesThroughAClosedWallOfAMillimetre) {
    for (const auto& [wall, small_triangles] : {std::pair(0.001, false), {0.001, true}, {0.0, false}}) {
        const DefaultLight light(two_rooms(wall, small_triangles));
        double most = 0;
        in_every_way([&](uint mode, uint rays) {
            EXPECT_GT(light.lux(mode, rays, {3.9, 1.5, 2.5}, down), 1);
            for (double beyond : {0.001, 0.01, 0.05, 0.3, 1.5})
                for (const glm::dvec3& way : {down, up, glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0)})
                    most = std::max(most, light.lux(mode, rays, {4 + wall + beyond, 1.5, 2.5}, way));
            EXPECT_EQ(most, 0) << wall;
        });
        tell_case("room beside a lit one, " + std::string(wall > 0 ? "1 mm of wall" : "sheets in one place") +
                      worded(small_triangles) + ", direct light exact, all modes",
                  "0 lx", "%.3g lx at most", most);
    }
}

/// A house of 8 m whose floor and ceiling go on behind one sheet, plain or of a millimetre.
Room parted_house(const Soup& wall) {
    Room room = plain_room();
    room.walls = joined(box({0, 0, 0}, {8, 3, 5}, true), wall);
    room.block.clear(), room.panel.clear();
    room.panel_luminance = 0;
    room.double_sided = true;
    room.lamp = {2, 2, 2.5};
    return room;
}

TEST(DefaultLight, StaysOnItsSideOfAWallThatPartsAFloor) {
    for (const auto& [name, wall] : {std::pair("a sheet", quad({4, 0, 0}, {0, 0, 5}, {0, 3, 0})),
                                     {"a wall of a millimetre", box({4, 0, 0}, {4.001, 3, 5}, false)}}) {
        const DefaultLight light(parted_house(wall));
        double most = 0;
        in_every_way([&](uint mode, uint rays) {
            for (double distance : {0.003, 0.01, 0.03, 0.08, 0.2})
                for (double z = 0.3; z < 4.8; z += 0.7) {
                    EXPECT_GT(light.lux(mode, rays, {4 - distance, 1.5, z}, down), 1);
                    for (const glm::dvec3& way : {down, up})
                        most = std::max(most, light.lux(mode, rays, {4.001 + distance, 1.5, z}, way));
                }
            EXPECT_EQ(most, 0) << name;
        });
        tell_case(std::string("floor and ceiling 2 mm to 20 cm behind ") + name + ", direct light exact, all modes",
                  "0 lx", "%.3g lx at most", most);
    }
}

TEST(DefaultLight, OfASheetACentimetreAboveTheFloorIsNotBelowIt) {
    for (int pieces : {1, 20}) {
        Room room = parted_house(divided(quad({1, 0.01, 1}, {0, 0, 2}, {2, 0, 0}), pieces));
        const DefaultLight light(room);
        double most = 0, min_above = 1e9;
        in_every_way([&](uint mode, uint rays) {
            for (double x : {1.5, 2.0, 2.5}) {  // half a metre from where light comes in under its borders
                min_above = std::min(min_above, light.lux(mode, rays, {x, 1.5, 2}, down));
                for (const glm::dvec3& way : {down, up})
                    most = std::max(most, light.lux(mode, rays, {x, 0.005, 2}, way));
            }
        });
        tell_case("sheet 1 cm above the floor, in " + std::to_string(2 * pieces * pieces) +
                      " triangles, direct light exact, all modes",
                  "below < 1 % of above", "%.1f lx above, %.2g below", min_above, most);
        EXPECT_GT(min_above, 20);
        EXPECT_LT(most, 0.01 * min_above) << pieces;
    }
}

TEST(DefaultLight, OfALampInAClosedShadeOrOutsideAClosedRoomIsNotInTheRoom) {
    for (const auto& [name, place] : {std::pair("lamp in a closed shade", glm::dvec3(1.1, 0.4, 1.4)),
                                      {"lamp outside a closed room", glm::dvec3(-3, 1, 1)},
                                      {"lamp above a closed room", glm::dvec3(2, 3.5, 2.5)}}) {
        Room room = plain_room();
        room.panel.clear(), room.panel_luminance = 0;
        room.lamp = place;
        const DefaultLight light(room);
        double most = 0;
        in_every_way([&](uint mode, uint rays) {
            for (const glm::dvec3& way : {down, up, glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1)})
                for (double x : {0.02, 2.5, 3.98}) {
                    const double lux = light.lux(mode, rays, {x, 1.5, 3}, way);
                    EXPECT_EQ(lux, 0) << name << " " << x << " " << way.x << " " << way.y << " " << way.z;
                    most = std::max(most, lux);
                }
        });
        tell_case(std::string(name) + ", in the room, direct light exact, all modes", "0 lx", "%.3g lx at most", most);
    }
}

TEST(DefaultLight, OfALampThatTouchesAWallIsWhatItSends) {
    for (double gap : {1e-3, 1e-2}) {  // less than rays start off a surface is behind it or not, as rounding has it
        Room room = plain_room();
        room.albedo = 0;  // what lands is known: I cos / d2
        room.block.clear(), room.panel.clear(), room.panel_luminance = 0;
        room.lamp = {gap, 1.5, 2.5};
        const DefaultLight light(room);
        double worst = 0;
        in_every_way([&](uint mode, uint rays) {
            for (double x : {0.3, 1.0, 2.5, 3.7}) {
                const glm::dvec3 way = room.lamp - glm::dvec3(x, 0, 2.5);
                const double expected = room.candela * way.y / std::pow(glm::length(way), 3);
                worst = std::max(worst, std::abs(light.lux(mode, rays, {x, 1.4, 2.5}, down) / expected - 1));
            }
            EXPECT_LT(worst, rays > 0 ? 1e-3 : 0.02) << gap;  // the lattice interpolates
        });
        tell_case("lamp " + std::to_string(int(1000 * gap)) + " mm before a wall, floor", "I cos / d2, +-2 %",
                  "%.2f %% at most", 100 * worst);
    }
}

}  // namespace
}  // namespace lw::test
