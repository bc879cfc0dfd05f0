// Sensors: powers stay live, walls do not leak, the same at any thread count; grids, points, tasks, isolux lines.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"
#include "base/parallel.h"
#include "benchmark/lab_scene.h"
#include "maps/bake.h"
#include "measure/grid.h"
#include "measure/html.h"
#include "measure/isolux.h"
#include "measure/survey.h"
#include "measure/table.h"
#include "measure/view.h"
#include "programs/command.h"

namespace lw {
namespace {

/// A room of two chambers with a wall without thickness between them; a lamp in the west one, none in the east one.
Scene two_chambers() {
    LabScene lab;
    lab.add_room({0, 0, 0}, {4, 2, 2}, 0.6f);
    lab.add_rectangle("wall", {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0.6f);
    lab.add_point({1, 1, 1}, 100);
    lab.add_rectangle("panel", {0.5f, 1.9f, 0.5f}, {0.3f, 0, 0}, {0, 0, 0.3f}, 0, 2000);
    return lab.finish();
}

Survey survey_of(const Scene& scene, std::vector<SensorSet> sets, std::vector<AmbianceFactors> ambiances) {
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 50'000});
    return make_survey(scene, caster, map, std::move(sets), std::move(ambiances), {});
}

SensorSet points(std::vector<Sensor> sensors) {
    return {SensorSet::Kind::points, "points", "", std::move(sensors), {}, {}};
}

TEST(Meter, LightDoesNotPassAWallWithoutThickness) {
    const Scene scene = two_chambers();
    std::vector<Sensor> east;
    for (const float x : {2.0f, 2.0005f, 2.001f, 2.01f, 3.0f}) east.push_back({{x, 1, 1}, {1, 0, 0}, Response::planar});
    east.push_back({{2, 0, 0}, {1, 0, 0}, Response::planar});  // in a corner of three surfaces
    east.push_back({{3, 0, 1}, {0, 1, 0}, Response::planar});
    const Survey survey = survey_of(scene, {points(east)}, {{"all", {vec3(1), vec3(1)}}});
    for (const Value& value : values_of(survey.sets[0], survey.ambiances[0], 1))
        EXPECT_LT(value.lux, 1e-3);  // the other side has more than 100 lx
}

TEST(Meter, SensorsOnSurfacesAndInCornersSeeTheirSide) {
    const Scene scene = two_chambers();
    const Survey survey = survey_of(scene,
                                    {points({{{2, 1, 1}, {-1, 0, 0}, Response::planar},
                                             {{1.999f, 1, 1}, {-1, 0, 0}, Response::planar},
                                             {{0, 0, 0}, {0, 1, 0}, Response::planar},
                                             {{0.002f, 0.001f, 0.002f}, {0, 1, 0}, Response::planar}})},
                                    {{"all", {vec3(1), vec3(0)}}});
    const std::vector<Value> v = values_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_GT(v[0].lux, 100);  // the direct light alone is 100 lx
    EXPECT_NEAR(v[0].lux / v[1].lux, 1, 0.05);
    EXPECT_GT(v[2].lux, 100 / std::pow(3.0, 1.5));
    EXPECT_NEAR(v[2].lux / v[3].lux, 1, 0.05);
}

TEST(Meter, ValuesAreLinearInThePowers) {
    const Scene scene = two_chambers();
    const Survey survey =
        survey_of(scene, {points({{{1, 0.7f, 1.5f}, {0, 1, 0}, Response::planar}})},
                  {{"point", {vec3(1), vec3(0)}}, {"panel", {vec3(0), vec3(1)}}, {"both", {vec3(0.25f), vec3(3)}}});
    double lux[3];
    for (size_t a = 0; a < 3; ++a) lux[a] = values_of(survey.sets[0], survey.ambiances[a], 1)[0].lux;
    EXPECT_NEAR(lux[2], 0.25 * lux[0] + 3 * lux[1], 1e-4 * lux[2]);
    EXPECT_NEAR(values_of(survey.sets[0], survey.ambiances[2], 0.8f)[0].lux, 0.8 * lux[2], 1e-4 * lux[2]);
}

TEST(Meter, ReadsTheSameAtAnyThreadCount) {
    const Scene scene = two_chambers();
    std::vector<Sensor> sensors;
    for (int i = 0; i < 20; ++i) sensors.push_back({{0.1f + 0.09f * float(i), 0.8f, 1}, {0, 1, 0}, Response::planar});
    std::vector<std::string> tables;
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        tables.push_back(sensors_as_csv(survey_of(scene, {points(sensors)}, {{"all", {vec3(1), vec3(1)}}}), scene));
    }
    EXPECT_EQ(tables[0], tables[1]);
}

TEST(Meter, AnErrorAskedForIsReachedByBakingAgain) {
    const Scene scene = two_chambers();
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 2000});
    SurveySettings settings;
    settings.error = 0.02;
    const Survey survey = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                      {{"all", {vec3(1), vec3(1)}}}, settings);
    EXPECT_GT(survey.bakes, 0u);
    EXPECT_GT(survey.map.stored_photons, map.stored_photons);
    EXPECT_LE(values_of(survey.sets[0], survey.ambiances[0], 1)[0].relative(), 0.02);
    EXPECT_EQ(survey.unreached, 0u);
    settings.max_photons = 4000;
    const Survey bounded = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                       {{"all", {vec3(1), vec3(1)}}}, settings);
    EXPECT_EQ(bounded.unreached, 1u);
    EXPECT_FALSE(bounded.warnings.empty());
}

TEST(Meter, TooFewPhotonsAreDoubted) {
    const Scene scene = two_chambers();
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 60});
    const Survey survey = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                      {{"all", {vec3(1), vec3(1)}}}, {});
    EXPECT_FALSE(values_of(survey.sets[0], survey.ambiances[0], 1)[0].doubt.empty());
}

TEST(Grid, SpacingFollowsEn12464) {
    EXPECT_NEAR(grid_spacing(1), 0.2, 1e-9);
    EXPECT_NEAR(grid_spacing(10), 1.0, 1e-9);
    EXPECT_NEAR(grid_spacing(100), 5.0, 1e-9);
    EXPECT_NEAR(grid_spacing(5), 0.2 * std::pow(5, std::log10(5.0)), 1e-9);
    EXPECT_EQ(grid_spacing(1e6), 10);
    const Scene scene = two_chambers();
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
    const Scene scene = two_chambers();
    EXPECT_NE(test::error_of([&] { make_surface("table", scene); }).find("no object of this name; there are: ceiling"),
              std::string::npos);
    EXPECT_NE(test::error_of([&] { make_surface("floor: facing=-y", scene); }).find("no face that looks this way"),
              std::string::npos);
    EXPECT_NE(
        test::error_of([&] { make_grid(parse_grid("g: 0,0,0 to 10,0,10 spacing=0.001"), scene); }).find("a million"),
        std::string::npos);
}

TEST(Grid, PointsOfAFileAndTheirErrors) {
    const Scene scene = two_chambers();
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
    const Scene scene = two_chambers();
    const SensorSet set = make_surface("floor: count=1000", scene);
    size_t west = 0;
    for (const Sensor& sensor : set.sensors) {
        west += sensor.position.x < 2;
        EXPECT_NEAR(sensor.position.y, 1e-3f, 1e-6f);
    }
    EXPECT_NEAR(double(west), 500, 20);
}

TEST(Statistics, JudgeATaskOnlyOutsideTheInterval) {
    const auto judged = [](double average, double half_width) {
        Statistics s;
        s.count = 1;
        s.average = {average, half_width};
        s.u0 = {0.7, 0.01};
        return judge(s, find_task("office")).both();
    };
    EXPECT_EQ(judged(520, 10), Verdict::pass);
    EXPECT_EQ(judged(505, 10), Verdict::undecided);
    EXPECT_EQ(judged(495, 10), Verdict::undecided);
    EXPECT_EQ(judged(480, 10), Verdict::fail);
    EXPECT_EQ(judge(Statistics{}, find_task("office")).both(), Verdict::undecided) << "all sensors blocked";
    Reading unlit;
    unlit.lamps.assign(2, ChannelLux(0));
    const Value dark;
    const Statistics outside = statistics_of(std::span(&unlit, 1), std::span(&dark, 1));
    EXPECT_EQ(judge(outside, find_task("office")).both(), Verdict::undecided) << "outside the room";
    EXPECT_NE(test::error_of([] { find_task("nap"); }).find("there are: office"), std::string::npos);
}

TEST(Isolux, LineOfAConeIsACircle) {
    constexpr uint n = 41;
    std::vector<double> values;
    for (uint y = 0; y < n; ++y)
        for (uint x = 0; x < n; ++x) values.push_back(100 - std::hypot(double(x) - 20, double(y) - 20));
    const std::vector<IsoluxSegment> line = isolux_line(values, n, n, 90);
    double around = 0;
    for (const IsoluxSegment& s : line) {
        EXPECT_NEAR(length(s.from - vec2(20.5f)), 10, 0.05);
        around += double(length(s.to - s.from));
    }
    EXPECT_NEAR(around, 2 * double(lw_pi) * 10, 0.2);
}

TEST(Report, TextOfTheSceneIsEscaped) { EXPECT_EQ(escaped("<b>&\"x\""), "&lt;b&gt;&amp;&quot;x&quot;"); }

TEST(Report, APictureOfASunlitRoomShowsItsDimPartsToo) {
    std::vector<double> lux(100, 0.0);  // sees nothing
    for (int i = 0; i < 970; ++i) lux.push_back(10 + 0.1 * i);
    lux.insert(lux.end(), 30, 5000);
    const auto [low, high] = range_of_picture(lux);
    EXPECT_EQ(high, 5000);
    EXPECT_NEAR(low, 11, 0.2);
    EXPECT_EQ(range_of_picture({1e-9, 1, 1}).first, 1e-3);  // three decades
    EXPECT_EQ(range_of_picture({7, 7, 7}), std::pair(3.5, 7.0));
    EXPECT_GT(range_of_picture({0, 0}).second, 0);
}

TEST(Report, LabelsOfIsoluxLinesDoNotHideNumbers) {
    MeasuredSet field;
    field.set.kind = SensorSet::Kind::grid;
    field.set.grid = {vec3(0), vec3(1, 0, 0), vec3(0, 0, 1), 3, 3};
    field.readings.resize(9);
    std::vector<Value> values(9);
    for (Value& value : values) value.lux = 400;
    values[4].lux = 182;
    const std::string drawing = grid_drawing(field, values, {1, 1, {0, 0, 0}}, 0.5f, 100, 400);
    EXPECT_NE(drawing.find(">300</text>"), std::string::npos);
    EXPECT_EQ(drawing.find(">200</text>"), std::string::npos) << "its line runs 0.08 cells around the 182";
}

TEST(Program, MeasuresTheCubeToAFileAndAReport) {
    const TempFolder folder;
    const Outcome outcome =
        run("measure", {"data/cube.gltf", "--photons", "20000", "--grid", "mid: -2,0,-2 to 2,0,2 task=office",
                        "--ambiance", "half: lamp=0.5", "--ambiance", "full:", "--csv", folder / "s.csv",
                        "--fields-csv", folder / "f.csv", "--report", folder / "r.html", "--camera", "inside"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("fail"), std::string::npos);
    EXPECT_EQ(read_text(folder / "f.csv").substr(0, 11), "field,task,");
    const std::string html = read_text(folder / "r.html");
    EXPECT_NE(html.find("</html>"), std::string::npos);
    EXPECT_EQ(html.find("http"), std::string::npos) << "nothing outside the file";
    EXPECT_EQ(folder.names().size(), 3u);
}

TEST(Program, AnErrorAskedForBakesWithoutAMapAndKeepsTheBake) {
    const TempFolder folder;
    const std::string scene = folder / "cube.gltf", map = folder / "kept.pmap";
    std::filesystem::copy_file(LUMENWALK_SOURCE_DIR "/data/cube.gltf", scene);
    const std::string grid = "mid: -1,0,-1 to 1,0,1 spacing=1";
    const Outcome baked = run("measure", {scene, "--grid", grid, "--error", "3", "--save-map", map});
    EXPECT_EQ(baked.exit_code, 0) << baked.err;
    EXPECT_NE(baked.out.find("million photons"), std::string::npos) << baked.out;
    EXPECT_NE(baked.out.find("wrote " + map), std::string::npos) << baked.out;
    const Outcome again = run("measure", {scene, map, "--grid", grid});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(run("measure", {scene, map, "--grid", grid, "--save-map", folder / "x.pmap"}).exit_code, 2);
    const Outcome nowhere =
        run("measure", {scene, "--grid", grid, "--photons", "2000", "--save-map", folder / "no/x.pmap"});
    EXPECT_EQ(nowhere.exit_code, 1);
    EXPECT_NE(nowhere.err.find("x.pmap"), std::string::npos) << nowhere.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube.gltf", "kept.pmap"}));
}

TEST(Program, ComparesItsSensorsWithPathTracing) {
    const TempFolder folder;
    const Outcome outcome =
        run("measure", {"data/cube.gltf", "--photons", "50000", "--grid", "mid: -1,0,-1 to 1,0,1 spacing=0.5",
                        "--reference", "4000", "--csv", folder / "s.csv", "--report", folder / "r.html"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("path traced: "), std::string::npos) << outcome.out;
    EXPECT_NE(read_text(folder / "s.csv").find(",yes,"), std::string::npos);
    EXPECT_NE(read_text(folder / "r.html").find("Compared with path tracing"), std::string::npos);
}

TEST(Program, FindsTheReflectionsOfAViewAndNoneInItsMatteTwin) {
    const TempFolder folder;
    const std::string csv = folder / "r.csv";
    const Outcome bright =
        run("measure", {"data/bad_reflections.gltf", "--reflections", "desk", "--reflections-csv", csv});
    EXPECT_EQ(bright.exit_code, 0) << bright.err;
    EXPECT_NE(bright.out.find("window mirrors desk_2"), std::string::npos) << bright.out;
    EXPECT_NE(bright.out.find("picture mirrors desk_1"), std::string::npos) << bright.out;
    EXPECT_NE(read_text(csv).find("\"window\",\"desk_2\","), std::string::npos);
    const Outcome dark = run("measure", {"data/bad_reflections.gltf", "--reflections", "desk", "--power", "desk_2=0"});
    EXPECT_EQ(dark.out.find("desk_2"), std::string::npos) << dark.out;
    const Outcome matte = run("measure", {"data/bad_reflections_matte.gltf", "--reflections", "desk"});
    EXPECT_NE(matte.out.find(" 0 reflections"), std::string::npos) << matte.out;
    EXPECT_EQ(run("measure", {"data/bad_reflections.gltf", "--reflections", "nowhere"}).exit_code, 1);
    EXPECT_EQ(run("measure", {"data/bad_reflections.gltf", "--reflections-csv", csv}).exit_code, 2);
}

TEST(Program, RefusesBadCommandLinesAndFiles) {
    const TempFolder folder;
    const std::string csv = folder / "s.csv";
    EXPECT_EQ(run("measure", {"data/cube.gltf"}).exit_code, 2);
    EXPECT_EQ(run("measure", {"data/cube.gltf", "--grid", "g: 0,0,0 to 1,0,1", "--rays", "0"}).exit_code, 2);
    const std::vector<std::vector<std::string>> bad = {
        {"data/cube.gltf", "--photons", "2000", "--grid", "g", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1 task=nap", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--points", folder / "missing.csv", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1", "--ambiance", "a: sun=1", "--csv", csv},
        {"data/cube.gltf", folder / "missing.pmap", "--grid", "g: 0,0,0 to 1,0,1", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1", "--ies", "lamp=" + (folder / "no.ies"),
         "--csv", csv}};
    for (const std::vector<std::string>& arguments : bad) {
        const Outcome outcome = run("measure", arguments);
        EXPECT_EQ(outcome.exit_code, 1) << arguments[2];
        EXPECT_NE(outcome.err.find("lumenwalk-measure: "), std::string::npos) << outcome.err;
        EXPECT_TRUE(folder.names().empty());
    }
}

}  // namespace
}  // namespace lw
