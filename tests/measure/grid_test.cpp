// Where is measured: grids, points of a file, points of surfaces, and what is wrong with their texts.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"
#include "measure/grid.h"
#include "measure/two_chambers.h"
#include "programs/command.h"

namespace lw {
namespace {

TEST(Grid, SpacingFollowsEn12464) {
    EXPECT_NEAR(grid_spacing(1), 0.2, 1e-9);
    EXPECT_NEAR(grid_spacing(10), 1.0, 1e-9);
    EXPECT_NEAR(grid_spacing(100), 5.0, 1e-9);
    EXPECT_NEAR(grid_spacing(5), 0.2 * std::pow(5, std::log10(5.0)), 1e-9);
    EXPECT_EQ(grid_spacing(1e6), 10);
    const Scene scene = test::two_chambers();
    const SensorSet grid = make_grid(parse_grid("desk: 0,0.75,0 to 10,0.75,10 margin=0.5"), scene);
    EXPECT_EQ(grid.grid.columns, 10u);  // 9 m at 0.93 m
    EXPECT_NEAR(grid.sensors[0].position.x, 0.95f, 1e-5f);
    EXPECT_NEAR(grid.sensors.back().position.z, 9.05f, 1e-5f);
    const SensorSet corridor = make_grid(parse_grid("long: 0,0,0 to 20,0,2"), scene);
    EXPECT_LE(double(corridor.grid.along.z), grid_spacing(2) + 1e-6);  // the shorter side counts
}

TEST(Grid, BadTextsNameTheGridAndWhatIsWrong) {
    const std::pair<const char*, const char*> cases[] = {
        {"desk", "write NAME: X,Y,Z to X,Y,Z"},
        {"desk: 0,0,0 10,0,10", "write NAME"},
        {"desk: 0,0 to 10,0,10", "not a point"},
        {"desk: 0,0,x to 10,0,10", "not a number"},
        {"desk: 0,0,0 to 10,1,10", "do not span a rectangle"},
        {"desk: 0,0,0 to 10,0,10 margin=6", "wider than its margins"},
        {"desk: 0,0,0 to 10,0,10 colour=red", "none of"},
        {"desk: 0,0,0 to 10,0,10 spacing=0", "lengths in metres"},
        {"desk: 0,0,0 to 10,0,10 facing=up", "write one of"},
        {"desk: 0,0,0 to 10,0,10 kind=round", "planar or cylindrical"},
    };
    for (const auto& [text, what] : cases) {
        const std::string error = test::error_of([&] { parse_grid(text); });
        EXPECT_NE(error.find(what), std::string::npos) << text << ": " << error;
        EXPECT_NE(error.find("desk"), std::string::npos) << text << ": " << error;
    }
    const Scene scene = test::two_chambers();
    EXPECT_NE(test::error_of([&] { make_surface("table", scene); }).find("no object of this name; there are: ceiling"),
              std::string::npos);
    EXPECT_NE(test::error_of([&] { make_surface("floor: facing=-y", scene); }).find("no face that looks this way"),
              std::string::npos);
    EXPECT_NE(
        test::error_of([&] { make_grid(parse_grid("g: 0,0,0 to 10,0,10 spacing=0.001"), scene); }).find("a million"),
        std::string::npos);
}

TEST(Grid, PointsOfAFileAndTheirErrors) {
    const Scene scene = test::two_chambers();
    const TempFolder folder;
    write_text(folder / "p.csv",
               "name,x,y,z\nseat,1,1.2,1\nwall,1,1,0.1,0,0,2,planar\nface,1,1.6,1,0,1,0,cylindrical\n");
    const SensorSet set = read_points(folder / "p.csv", scene);
    ASSERT_EQ(set.sensors.size(), 3u);
    EXPECT_EQ(set.sensor_names[1], "wall");
    EXPECT_EQ(set.sensors[1].normal, vec3(0, 0, 1));
    EXPECT_EQ(set.sensors[2].response, Response::cylindrical);
    write_text(folder / "marked.csv", "\xEF\xBB\xBFname,x,y,z\r\nseat,1,1.2,1\r\n");  // as spreadsheets write it
    EXPECT_EQ(read_points(folder / "marked.csv", scene).sensors.size(), 1u);
    write_text(folder / "bad.csv", "name,x,y,z\nseat,1,1.2\n");
    EXPECT_NE(test::error_of([&] { read_points(folder / "bad.csv", scene); }).find("bad.csv: line 2: "),
              std::string::npos);
    write_text(folder / "nan.csv", "seat,1,nan,3\n");
    EXPECT_NE(test::error_of([&] { read_points(folder / "nan.csv", scene); }).find("line 1: "), std::string::npos);
    write_text(folder / "empty.csv", "name,x,y,z\n");
    EXPECT_NE(test::error_of([&] { read_points(folder / "empty.csv", scene); }).find("no points"), std::string::npos);
}

TEST(Grid, SurfacePointsAreEvenByArea) {
    const Scene scene = test::two_chambers();
    const SensorSet set = make_surface("floor: count=1000", scene);
    size_t west = 0;
    for (const Sensor& sensor : set.sensors) {
        west += sensor.position.x < 2;
        EXPECT_NEAR(sensor.position.y, 1e-3f, 1e-6f);
    }
    EXPECT_NEAR(double(west), 500, 20);
}

}  // namespace
}  // namespace lw
