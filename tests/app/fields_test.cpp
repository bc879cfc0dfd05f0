// Calculation grids of the window: the numbers of lumenwalk-measure, live under dimming, read behind the window's back.
#include "app/measuring/fields.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/display.h"
#include "app/measuring/field_reader.h"
#include "app/measuring/metering.h"
#include "maps/bake.h"

namespace lw {
namespace {

struct Cube {
    Cube()
        : world(LUMENWALK_SOURCE_DIR "/data/cube.gltf", {}, {}),
          map(std::make_shared<const PhotonMap>(bake(world.scene, world.caster, {.photons = 20'000}))),
          reader(world.scene, world.caster) {}

    void read(Fields& fields) {
        ASSERT_TRUE(wait_until([&] { return reader.follow(fields, map); }));
        value_fields(fields, {vec3(1)});
    }

    World world;
    std::shared_ptr<const PhotonMap> map;
    FieldReader reader;
};

const char* desk = "desk: -1,-1.25,-1 to 1,-1.25,1 spacing=0.5";

TEST(Fields, AreThoseOfLumenwalkMeasure) {
    Cube cube;
    Fields fields;
    add_field(fields, parse_grid(desk), cube.world.scene);
    EXPECT_EQ(summary_of(fields.fields[0]), "being read");
    cube.read(fields);
    const Field& field = fields.fields[0];
    EXPECT_TRUE(field.is_current);
    const Survey survey =
        make_survey(cube.world.scene, cube.world.caster, *cube.map, {field.set}, {{"all", {vec3(1)}}}, {});
    const Statistics expected = statistics_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_NEAR(field.statistics.average.value, expected.average.value, 0.01 * expected.average.value);
    EXPECT_NEAR(field.statistics.u0.value, expected.u0.value, 0.03);
    const double direct = 100 / (1.25 * 1.25);  // right under the lamp of 100 cd, 1.25 m above
    EXPECT_NEAR(field.statistics.maximum.value, direct + 13, 0.25 * direct);
    EXPECT_NE(summary_of(field).find("Eavg"), std::string::npos);
}

TEST(Fields, FollowTheDimmersWithoutBeingReadAgain) {
    Cube cube;
    Fields fields;
    add_field(fields, parse_grid(desk), cube.world.scene);
    cube.read(fields);
    const Statistics full = fields.fields[0].statistics;
    value_fields(fields, {vec3(0.25f)});
    EXPECT_NEAR(fields.fields[0].statistics.average.value, 0.25 * full.average.value, 1e-4 * full.average.value);
    EXPECT_NEAR(fields.fields[0].statistics.average.half_width, 0.25 * full.average.half_width,
                1e-3 * full.average.half_width);
    EXPECT_NEAR(fields.fields[0].statistics.u0.value, full.u0.value, 1e-6);
    value_fields(fields, {vec3(0)});
    EXPECT_EQ(fields.fields[0].statistics.maximum.value, 0);
}

TEST(Fields, AreReadAgainFromANewMapAndGivenUpWithTheWindow) {
    Cube cube;
    Fields fields;
    add_field(fields, parse_grid(desk), cube.world.scene);
    cube.read(fields);
    const auto other = std::make_shared<const PhotonMap>(*cube.map);
    EXPECT_FALSE(cube.reader.follow(fields, other));
    EXPECT_FALSE(fields.fields[0].is_current);
    EXPECT_TRUE(wait_until([&] { return cube.reader.follow(fields, other); }));
    EXPECT_TRUE(fields.fields[0].is_current);
    add_field(fields, parse_grid("fine: -1.9,-1.9,-1.9 to 1.9,-1.9,1.9 spacing=0.1"), cube.world.scene);
    cube.reader.follow(fields, other);  // ends while it is at work
    EXPECT_TRUE(cube.reader.progress());
}

TEST(Fields, RefuseWhatNobodyWouldWaitForAndWhatIsTooThin) {
    Cube cube;
    Fields fields;
    EXPECT_THROW(add_field(fields, parse_grid("all: -2,0,-2 to 2,0,2 spacing=0.02"), cube.world.scene), Error);
    EXPECT_THROW(request_between(fields, vec3(0), vec3(1, 0, 0.05f), cube.world.scene), Error);
    EXPECT_TRUE(fields.fields.empty());
}

TEST(Fields, AGridByTwoCornersLiesOverThemAndItsTextMakesItAgain) {
    Cube cube;
    Fields fields;
    const vec3 low = cube.world.scene.bounds[0];
    const GridRequest request =
        request_between(fields, low + vec3(3, 0, 1), low + vec3(1, 0.2f, 3.5f), cube.world.scene);
    const glm::dvec3 floor = cube.world.scene.origin + glm::dvec3(low);
    EXPECT_NEAR(request.low.y, floor.y + 0.75, 1e-5);
    EXPECT_NEAR(request.low.x, floor.x + 1, 1e-5);
    EXPECT_NEAR(request.high.z, floor.z + 3.5, 1e-5);
    GridRequest written = request;
    written.margin = 0.5, written.facing = vec3(0, -1, 0), written.task = "office";
    const GridRequest again = parse_grid(text_of(written));
    EXPECT_EQ(again.name, written.name);
    EXPECT_NEAR(length(again.high - written.high), 0, 1e-3);
    EXPECT_EQ(again.margin, 0.5);
    EXPECT_EQ(again.facing, written.facing);
    EXPECT_EQ(again.task, "office");
}

TEST(Fields, TwoClicksInTheWindowMakeOneAndItsTablesAreSaved) {
    Cube cube;
    const TempFolder folder;
    Session session(cube.world, folder.path());
    session.walker.pitch = -0.7f;
    toggle_field_choice(session);
    choose_corner(session, {60, 300}, {640, 400});
    EXPECT_TRUE(session.fields.corner);
    choose_corner(session, {580, 390}, {640, 400});
    ASSERT_EQ(session.fields.fields.size(), 1u) << session.notice.text;
    EXPECT_FALSE(session.fields.chooses);
    cube.read(session.fields);
    EXPECT_GT(session.fields.fields[0].statistics.average.value, 5);
    save_fields(session);
    const std::string sums = read_text(folder / "cube-001.grids.csv"),
                      points = read_text(folder / "cube-001.sensors.csv");
    EXPECT_EQ(std::count(sums.begin(), sums.end(), '\n'), 2) << sums;
    EXPECT_EQ(size_t(std::count(points.begin(), points.end(), '\n')), 1 + session.fields.fields[0].set.sensors.size());
    session.fields.text = "nonsense";
    add_written_field(session);
    EXPECT_NE(session.notice.text.find("nonsense"), std::string::npos);
    EXPECT_EQ(session.fields.fields.size(), 1u);
}

TEST(Pins, ReadNothingBeforeTheNearPlaneAsThePictureShowsNothing) {
    const Cube cube;
    const TempFolder folder;
    Session session(cube.world, folder.path());
    session.metering.on = true;
    const Probe probe(cube.world.scene, cube.world.caster, *cube.map, cube.world.bvh);
    for (const float near : {0.01f, 20.0f}) {
        session.near = near;
        session.metering.pins.clear();
        measure_again(session, probe, false);
        pin_at(session, probe, {100, 100}, {640, 400});
        EXPECT_EQ(session.metering.live.has_value(), near < 1);
        EXPECT_EQ(session.metering.pins.size(), near < 1 ? 1u : 0u);
    }
}

TEST(Pins, ThatReadNoLightAreNotSaved) {
    const Cube cube;
    const TempFolder folder;
    Session session(cube.world, folder.path());
    session.walker.pitch = -0.7f;
    const Probe probe(cube.world.scene, cube.world.caster, *cube.map, cube.world.bvh);
    pin_at(session, probe, {100, 100}, {640, 400});
    pin_at(session, probe, {320, 200}, {640, 400});
    ASSERT_EQ(session.metering.pins.size(), 2u);
    const Measurement read = session.metering.pins[1].value;
    for (float Measurement::*number : {&Measurement::lux, &Measurement::half_width_lux, &Measurement::luminance})
        for (float no_light : {NAN, INFINITY, -1.0f}) {
            session.metering.pins[1].value = read;
            session.metering.pins[1].value.*number = no_light;
            save_pins(session);
            EXPECT_NE(session.notice.text.find("pin 2 reads "), std::string::npos) << session.notice.text;
            EXPECT_NE(session.notice.text.find(", which is no light"), std::string::npos) << session.notice.text;
            EXPECT_EQ(folder.names(), std::vector<std::string>{}) << no_light;
        }
    session.metering.pins[1].value = read;
    save_pins(session);
    const std::string table = read_text(folder / "cube-001.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << session.notice.text << table;
}

}  // namespace
}  // namespace lw
