// Light where it is hard: walls of a millimetre, sheets above sheets, surfaces that keep all or nothing, lamps in odd
// places, too few photons, photons in one point, sensors on edges. Every reading is a number, and the right one.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "maps/build.h"
#include "maps/estimate.h"
#include "measure/light_meter.h"
#include "photons/shoot.h"
#include "robustness/room.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};

bool is_light(vec3 v) { return std::isfinite(v.x + v.y + v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0; }

/// Illuminance below `height` at (x, z) of the room, looking straight down.
double lux_below(const Baked& baked, const Room& room, glm::dvec3 from, uint mode) {
    const Bvh bvh = build_bvh(baked.scene);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 4}, bvh);
    const glm::dvec3 world = glm::dvec3(room.node * glm::dvec4(from, 1)) - baked.scene.origin;
    const std::optional<Hit> hit = baked.caster.nearest(vec3(world), vec3(0, -1, 0));
    if (!hit) throw Error("nothing below");
    return precise_luminance(estimator.estimate(hit->triangle, hit->barycentrics, vec3(0, 1, 0)).irradiance);
}

/// All readings are numbers, on corners and edges of all triangles too; returns the largest.
double check_everywhere(const Baked& baked, const Room& room) {
    const Bvh bvh = build_bvh(baked.scene);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    double most = 0;
    for (uint mode : modes)
        for (uint neighbours : {1u, 50u, 1'000'000u}) {
            const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, neighbours, 1}, bvh);
            for (uint t = 0; t < baked.scene.triangles.size(); ++t)
                for (const vec2 at : {vec2(0), vec2(1, 0), vec2(0, 1), vec2(0.5f, 0), vec2(0.5f, 0.5f), vec2(0.3f)})
                    for (float side : {1.0f, -1.0f}) {
                        const Surface s = estimator.surface_at(t, at);
                        const Gathered light = estimator.estimate(t, at, s.geometric_normal * side);
                        EXPECT_TRUE(is_light(light.irradiance) && is_light(light.radiance))
                            << "mode " << mode << " k " << neighbours << " triangle " << t;
                        most = std::max(most, precise_luminance(light.irradiance));
                    }
        }
    for (double lux : read(baked, room, gather_mode_smooth).lux) EXPECT_TRUE(std::isfinite(lux));
    return most;
}

Room two_rooms(double wall, bool small_triangles) {
    Room room = plain_room();
    Soup dark = box({4 + wall, 0, 0}, {8, 3, 5}, true);
    if (small_triangles) dark = divided(dark, 40);
    room.walls = joined(small_triangles ? divided(room.walls, 40) : room.walls, dark);
    room.block.clear();
    return room;
}

TEST(Light, NeverComesThroughAClosedWallOfAMillimetre) {
    for (const auto& [wall, small_triangles] : {std::pair(0.001, false), {0.001, true}, {0.0, false}, {0.0, true}}) {
        const Room room = two_rooms(wall, small_triangles);  // of 0 m: two sheets in one place
        const Baked baked(room, 200'000, 1, true);
        for (const Photon& photon : baked.photons.records)
            ASSERT_LT(double(photon.position.x) + baked.scene.origin.x, 4.0005);
        for (uint mode : modes) {
            EXPECT_GT(lux_below(baked, room, {3.9, 1.5, 2.5}, mode), 1);
            for (double beyond : {0.001, 0.01, 0.05, 0.3, 1.5})
                EXPECT_EQ(lux_below(baked, room, {4 + wall + beyond, 1.5, 2.5}, mode), 0) << mode << " " << beyond;
        }
        tell_case(std::string("closed room beside a lit one, ") + (wall > 0 ? "1 mm of wall" : "sheets in one place") +
                      (small_triangles ? ", small triangles" : ""),
                  "0 lx", "0 lx from 1 mm to 1.5 m behind the wall: %s", HasFailure() ? "no" : "yes");
    }
}

TEST(Light, OfAParallelSheetACentimetreAboveStaysThere) {
    for (int pieces : {1, 60}) {
        Room room = plain_room();
        room.block.clear();
        room.panel_luminance = 0;
        room.panel.clear();
        Soup sheet = quad({1, 0.01, 1}, {0, 0, 2}, {2, 0, 0});
        room.walls = divided(
            joined(room.walls, joined(sheet, moved(sheet, [](glm::dvec3 p) { return p - glm::dvec3(0, 1e-4, 0); }))),
            pieces);
        const Baked baked(room, 200'000, 1, true);
        double above = 1e9, below = 0;
        for (uint mode : modes) {
            above = std::min(above, lux_below(baked, room, {2, 1.5, 2}, mode));
            below = std::max(below, lux_below(baked, room, {2, 0.005, 2}, mode));
        }
        tell_case("parallel sheet 1 cm above another, each triangle in " + std::to_string(pieces * pieces),
                  "below < 1 % of above", "%.1f lx above, %.2g below", above, below);
        EXPECT_GT(above, 20) << pieces;
        EXPECT_LT(below, 0.01 * above) << pieces;
    }
}

TEST(Light, OfAClosedRoomSumsToWhatItsAlbedoSays) {
    for (const double albedo : {0.0, 0.5, 0.9, 0.99}) {
        Room room = plain_room();
        room.albedo = albedo;
        room.panel.clear(), room.panel_luminance = 0, room.block.clear();
        const Baked baked(room, 200'000, 1, true);
        double landed = 0;
        for (const Photon& p : baked.photons.records) landed += double(p.flux.y);
        tell_case("albedo " + std::to_string(albedo).substr(0, 4),
                  "flux / (1 - albedo), +-2 % (0.99: 6 %, 2,000 paths)", "%+.2f %%",
                  100 * (landed * (1 - albedo) / (4 * M_PI) - 1));
        EXPECT_NEAR(landed * (1 - albedo) / (4 * M_PI), 1, albedo > 0.95 ? 0.06 : 0.02) << albedo;  // 2,000 paths
        const LightBalance& balance = baked.photons.lights[0];
        EXPECT_NEAR((balance.absorbed + balance.escaped) / balance.flux_out, 1, 1e-6) << albedo;
        check_everywhere(baked, room);
    }
}

TEST(Light, InARoomThatAbsorbsNothingEnds) {
    Room room = plain_room();
    room.albedo = 1;
    const Baked baked(room, 20'000);
    EXPECT_FALSE(baked.photons.records.empty());
    check_everywhere(baked, room);
    tell_case("albedo 1", "paths end, light everywhere", "%zu photons", baked.photons.records.size());
}

TEST(Light, InABlackRoomIsTheDirectOne) {
    Room room = plain_room();
    room.albedo = 0;
    room.panel.clear(), room.panel_luminance = 0, room.block.clear();
    const Baked baked(room, 20'000);
    EXPECT_TRUE(baked.photons.records.empty());
    tell_case("black room, under the lamp", "62.0 lx (I / d2), +-0.01", "%.2f lx",
              lux_below(baked, room, {2.5, 1, 2.5}, gather_mode_cached));
    EXPECT_NEAR(lux_below(baked, room, {2.5, 1, 2.5}, gather_mode_cached), 300 / (2.2 * 2.2), 0.01);
    check_everywhere(baked, room);
}

TEST(Light, OfALampInAnOddPlaceIsANumber) {
    const std::pair<const char*, glm::dvec3> places[] = {
        {"lamp touching a wall", {0, 1.5, 2.5}}, {"lamp in a corner", {0, 0, 0}},
        {"lamp on an edge", {4, 3, 2}},          {"lamp outside the scene", {-3, 1, 1}},
        {"lamp 170 km away", {1e5, 1e5, 1e5}},   {"lamp inside furniture", {1.1, 0.4, 1.4}}};
    for (const auto& [name, place] : places) {
        Room room = plain_room();
        room.lamp = place;
        const Baked baked(room, 5'000);
        const double most = check_everywhere(baked, room);
        tell_case(name, "finite, >= 0 everywhere", "at most %.3g lx", most);
    }
}

TEST(Light, OfALampInAClosedShadeStaysInside) {
    Room room = plain_room();
    room.lamp = {1.1, 0.4, 1.4};  // inside the block, whose front is outside
    room.panel.clear(), room.panel_luminance = 0;
    const Baked baked(room, 20'000, 1, true);
    for (uint mode : modes) EXPECT_EQ(lux_below(baked, room, {3, 1, 4}, mode), 0);
    tell_case("lamp in a closed shade, outside of it", "0 lx", "%.3g lx",
              lux_below(baked, room, {3, 1, 4}, gather_mode_cached));
}

TEST(Light, OfZeroPowerIsZero) {
    Room room = plain_room();
    room.candela = room.panel_luminance = 0;
    room.panel.clear();
    const Baked baked(room, 5'000);
    const double most = check_everywhere(baked, room);
    tell_case("lamp of power 0", "0 lx everywhere", "%.3g lx at most", most);
    EXPECT_EQ(most, 0);
}

TEST(Light, OfADimLampStandsBesideOneAMillionTimesBrighter) {
    Room room = plain_room(), alone = plain_room();
    room.candela = 300e6, room.panel_luminance = 2000;
    alone.candela = 0;
    const Baked both(room), one(alone);
    std::vector<vec3> dim = lamp_powers(both.scene, {});
    ASSERT_EQ(both.scene.lights[0].type, light_point);
    dim[0] = vec3(0);
    const Bvh bvh = build_bvh(both.scene);
    const std::vector<vec3> full = lamp_powers(one.scene, {});
    const PhotonEstimator estimator(both.scene, both.map, dim, {gather_mode_cached, 200, 4}, bvh);
    const PhotonEstimator expected(one.scene, one.map, full, {gather_mode_cached, 200, 4}, bvh);
    double sum = 0, expected_sum = 0;
    for (uint t = 0; t < both.scene.triangles.size(); ++t) {
        const vec3 n = estimator.surface_at(t, vec2(0.3f)).geometric_normal;
        sum += precise_luminance(estimator.estimate(t, vec2(0.3f), n).irradiance);
        expected_sum += precise_luminance(expected.estimate(t, vec2(0.3f), n).irradiance);
    }
    tell_case("a lamp beside one a million times brighter, alone", "what it gives without the other, +-5 %", "%+.2f %%",
              100 * (sum / expected_sum - 1));
    EXPECT_NEAR(sum / expected_sum, 1, 0.05);
}

TEST(Light, OfOnePhotonOrNoneIsANumber) {
    for (uint64_t count : {1, 2, 3, 10}) {
        const Room room = plain_room();
        const Baked baked(room, count);
        check_everywhere(baked, room);
        Photons none;
        none.lights = baked.photons.lights;
        const PhotonMap empty = build_photon_map(baked.scene, baked.caster, none, {.photons = 1});
        EXPECT_TRUE(empty.places.empty());
        tell_case(std::to_string(count) + " photons asked for; k of 1 to a million", "finite, >= 0 everywhere",
                  "%zu stored: %s", baked.photons.records.size(), HasFailure() ? "no" : "yes");
    }
}

TEST(Light, OfPhotonsInOnePointIsANumberAndNotMoreThanThereIs) {
    const Room room = plain_room();
    Baked baked(room, 1'000);
    ASSERT_FALSE(baked.photons.records.empty());
    const Photon one = baked.photons.records[0];
    baked.photons.records.assign(5'000, one);
    baked.map = build_photon_map(baked.scene, baked.caster, baked.photons, {.photons = 5'000, .radius = 0.1f});
    check_everywhere(baked, room);
    EXPECT_EQ(baked.map.stored_photons, 5'000u);
    tell_case("5,000 photons in one point", "finite, >= 0 everywhere", "%s", HasFailure() ? "no" : "yes");
}

/// Sensors on vertices and edges of plain_room() and, in the same order, 2 cm off them on the same surface.
struct Edges {
    std::vector<Sensor> on, beside;
};

Edges edges_of(const Room& room, const Scene& scene) {
    Edges edges;
    const auto add = [&](glm::dvec3 place, glm::dvec3 normal, glm::dvec3 middle) {
        const glm::dvec3 off = glm::normalize(middle - place) * 0.02;
        const vec3 n(glm::normalize(glm::dmat3(room.node) * normal));
        const auto at = [&](glm::dvec3 p) { return vec3(glm::dvec3(room.node * glm::dvec4(p, 1)) - scene.origin); };
        edges.on.push_back({at(place), n, Response::planar});
        edges.beside.push_back({at(place + off), n, Response::planar});
    };
    const glm::dvec3 middle(2, 1.5, 2.5), up(0, 1, 0);
    for (double x : {0.0, 4.0})
        for (double z : {0.0, 5.0}) {
            add({x, 0, z}, up, middle);  // vertices, whose surfaces are at right angles
            add({x, 3, z}, -up, middle);
            add({x, 1.5, z}, {x > 0 ? -1 : 1, 0, 0}, middle);  // edges
        }
    add({2, 0, 0}, up, middle), add({2, 0, 2.5}, up, middle);  // an edge, and where two triangles of the floor meet
    const glm::dvec3 top(1.1, 0.8, 1.4);                       // of the block
    for (const glm::dvec3 place : {glm::dvec3(0.6, 0.8, 0.8), {1.6, 0.8, 2}, {1.6, 0.8, 1.4}, {1, 0.8, 2}})
        add(place, up, top);
    add({1.6, 0, 1.4}, up, {4, 0, 1.4}), add({1.6, 0, 2}, up, {4, 0, 4.4});  // its foot
    return edges;
}

TEST(Light, OfSensorsOnVerticesAndEdgesIsThatBesideThem) {
    Room turned = plain_room(), sheets = plain_room(), inside_out = plain_room();
    turned.node = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    inside_out.walls = box({0, 0, 0}, {4, 3, 5}, false);
    sheets.walls = inside_out.walls, sheets.double_sided = true;
    for (const auto& [name, room] : {std::pair("", plain_room()),
                                     {", of a turned room", turned},
                                     {", of walls turned away", inside_out},
                                     {", of double-sided walls turned away", sheets}}) {
        const Baked baked(room, 50'000);
        const Edges edges = edges_of(room, baked.scene);
        const std::vector<Reading> on = read_sensors(baked.scene, baked.caster, baked.map, edges.on, {});
        const std::vector<Reading> beside = read_sensors(baked.scene, baked.caster, baked.map, edges.beside, {});
        double worst = 0;
        int doubted = 0, wrong = 0;
        for (size_t i = 0; i < on.size(); ++i) {
            double a = 0, b = 0;
            for (size_t lamp = 0; lamp < baked.scene.lights.size(); ++lamp) {
                ASSERT_TRUE(std::isfinite(on[i].lamps[lamp].y) && on[i].lamps[lamp].y >= 0) << i;
                a += lux_of_lamp(on[i], lamp);
                b += lux_of_lamp(beside[i], lamp);
            }
            EXPECT_FALSE(beside[i].blocked) << name << " " << i;
            doubted += on[i].blocked;  // value_of() says so: it is told to be moved
            if (on[i].blocked) continue;
            worst = std::max(worst, std::abs(a / b - 1));
            wrong += std::abs(a / b - 1) > 0.15;
            EXPECT_NEAR(a / b, 1, 0.15) << name << " " << i;
        }
        tell_case(std::string("sensors on vertices and edges") + name,
                  "what they read 2 cm beside, +-15 %, or told to be blocked",
                  "%d of %zu blocked, %d wrong (%.0f %% at most)", doubted, on.size(), wrong, 100 * worst);
        EXPECT_EQ(doubted, 0) << name;
    }
}

}  // namespace
}  // namespace lw::test
