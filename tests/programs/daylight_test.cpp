// Daylight on the command line: a scene without a lamp is lit by it, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "image/exr.h"
#include "programs/command_lines.h"

namespace lw::test {
namespace {

std::string scene_without_lamp(const TempFolder& folder) {
    return edited_scene(folder, "cornell.gltf", "\"emissiveFactor\"", "\"no_lamp\"");
}

Outcome trace(const std::string& scene, const std::string& output, const Words& more) {
    Words words{scene, "-o", output, "--size", "16x12", "--samples", "4"};
    words.insert(words.end(), more.begin(), more.end());
    return run("reference", words);
}

TEST(DaylightPrograms, ASceneWithoutALampIsLitByTheSky) {
    const TempFolder folder;
    const std::string scene = scene_without_lamp(folder), picture = folder / "a.exr";
    expect_refusal(trace(scene, picture, {}), "has no light");
    expect_refusal(trace(scene, picture, {"--sky", "none"}), "has no light");
    expect_success(
        trace(scene, picture, {"--sky", "clear", "--place", "48.2,16.4", "--when", "2026-06-21T15:00+02:00"}));
    const Image lit = read_exr(picture);
    const std::vector<float>& green = lit.find("G")->values;
    EXPECT_GT(*std::max_element(green.begin(), green.end()), 100);
}

TEST(DaylightPrograms, PointsInTheOpenAreLitByAllOfTheSky) {
    const TempFolder folder;
    const std::string scene = scene_without_lamp(folder), csv = folder / "lux.csv";
    write_text(folder / "points.csv", "name,x,y,z\nfar,300,2,0\nside,300,2,0,0,0,-1\n");
    const Words words{scene,   "--points", folder / "points.csv", "--csv", csv,        "--paths", "20000",
                      "--sky", "uniform",  "--diffuse",           "10000", "--direct", "0",       "--ground-albedo",
                      "0.5"};
    const Outcome outcome = run("reference", words);
    expect_success(outcome);
    std::istringstream rows(read_text(csv));
    std::string heading, far, side;
    std::getline(rows, heading), std::getline(rows, far), std::getline(rows, side);
    EXPECT_EQ(heading, "field,sensor,x,y,z,nx,ny,nz,response,lux,standard_error");
    const auto lux_in = [](std::string row) {
        for (int column = 0; column < 9; ++column) row = row.substr(row.find(',') + 1);
        return std::stod(row);
    };
    EXPECT_NEAR(lux_in(far), 10'000, 100);
    EXPECT_NEAR(lux_in(side), 5000 + 2500, 100);
    EXPECT_EQ(far.rfind("points,far,300,2,0,0,1,0,planar,", 0), 0u) << far;
    EXPECT_EQ(run("reference", {scene, "--csv", csv, "-o", folder / "a.exr"}).exit_code, 2);
    expect_refusal(run("reference", {scene, "--sky", "uniform", "--diffuse", "1", "--points", folder / "points.csv",
                                     "--csv", folder / "points.csv"}),
                   "points.csv");
}

TEST(DaylightPrograms, OptionsThatDoNotGoTogetherAreMisuse) {
    const TempFolder folder;
    const Words misuses[] = {{"--sky", "blue"},
                             {"--sky", "clear"},
                             {"--sky", "clear", "--sun", "30"},
                             {"--sky", "clear", "--place", "48,16", "--when", "2026-06-21T15:00"},
                             {"--sky", "clear", "--sun", "30,180", "--diffuse", "nan"},
                             {"--sky", "clear", "--sun", "30,180", "--ground-albedo", "1.5"},
                             {"--diffuse", "10000"}};
    for (const Words& misuse : misuses) {
        const Outcome outcome = trace(scene_path("cube.gltf"), folder / "a.exr", misuse);
        EXPECT_EQ(outcome.exit_code, 2) << misuse.back() << ": " << outcome.err;
        EXPECT_TRUE(contains(outcome.err, "--")) << outcome.err;
    }
    EXPECT_EQ(folder.names(), Words{});
}

TEST(DaylightPrograms, AWeatherFileIsNeitherMissingNorOverwritten) {
    const TempFolder folder;
    const Words when{"--when", "2026-06-21T15:00+02:00", "--epw"};
    Words missing = when, damaged = when;
    missing.push_back(folder / "none.epw");
    expect_refusal(trace(scene_path("cube.gltf"), folder / "a.exr", missing), "none.epw: cannot be opened");
    write_text(folder / "a.epw", "LOCATION,Wien,-,AUT,IWEC,110360,48.12,here,1.0,190.0\n");
    damaged.push_back(folder / "a.epw");
    expect_refusal(trace(scene_path("cube.gltf"), folder / "a.exr", damaged), "a.epw: line 1: the longitude: \"here\"");
}

}  // namespace
}  // namespace lw::test
