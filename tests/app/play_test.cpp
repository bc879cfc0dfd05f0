// Replays without a window: pictures equal those of lumenwalk-screenshot, times are written, malformed paths refused.
#include <gtest/gtest.h>

#include <cmath>

#include "app/walk/places.h"
#include "image/png.h"
#include "programs/command.h"
#include "programs/lavapipe.h"
#include "scene/gltf.h"
#include "trace/ray_caster.h"

namespace lw {
namespace {

std::string cornell() { return LUMENWALK_SOURCE_DIR "/data/cornell.gltf"; }

TEST(Play, MakesThePicturesOfTheScreenshotProgramAndATableOfTimes) {
    SKIP_WITHOUT_LAVAPIPE();
    const TempFolder folder;
    const std::string map = folder / "map.pmap";
    ASSERT_EQ(run("bake", {cornell(), "-o", map, "--photons", "20000"}).exit_code, 0);
    write_text(
        folder / "path.json",
        R"({"fps": 4, "keys": [{"time": 1, "position": [0, 1, 3.9]}, {"time": 1.5, "position": [0.3, 1.2, 3], "yaw_deg": 8}]})");
    const Outcome played =
        run("", {cornell(), map, "--play", folder / "path.json", "--frames", folder / "frames", "--timings",
                 folder / "times.csv", "--size", "64x48", "--exposure", "5", "--validation", "--device", "llvmpipe"});
    ASSERT_EQ(played.exit_code, 0) << played.err;
    for (const char* words :
         {"3 frames", "frames/s", "cached irradiance, 4 shadow rays per emissive mesh, 1 view per pixel", "64x48",
          "median of passes: visibility "})
        EXPECT_NE(played.out.find(words), std::string::npos) << words << " is not in\n" << played.out;
    ASSERT_EQ(run("screenshot",
                  {cornell(), map, "-o", folder / "shot.png", "--size", "64x48", "--exposure", "5", "--samples", "1"})
                  .exit_code,
              0);
    const Rgb8Image first = read_png(folder / "frames/frame-0001.png");
    EXPECT_EQ(first.rgb, read_png(folder / "shot.png").rgb);
    EXPECT_NE(first.rgb, read_png(folder / "frames/frame-0003.png").rgb);
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/frame-0004.png"));
    const std::string table = read_text(folder / "times.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;

    const Outcome coarse = run("", {cornell(), map, "--play", folder / "path.json", "--frames", folder / "coarse",
                                    "--size", "64x48", "--exposure", "5", "--divisor", "2"});
    EXPECT_NE(coarse.out.find("64x48, light at 32x24"), std::string::npos) << coarse.out;
    const Rgb8Image divided = read_png(folder / "coarse/frame-0001.png");
    ASSERT_EQ(divided.rgb.size(), first.rgb.size());
    double difference = 0;
    for (size_t i = 0; i < first.rgb.size(); ++i)
        difference += std::abs(int(first.rgb[i]) - int(divided.rgb[i])) / double(first.rgb.size());
    EXPECT_GT(difference, 0.05);
    EXPECT_LT(difference, 16) << "levels of 255";
    const Outcome summed = run(
        "", {cornell(), map, "--play", folder / "path.json", "--size", "64x48", "--divisor", "2", "--samples", "6"});
    EXPECT_NE(summed.out.find("6 views per pixel, 64x48, light at 32x24"), std::string::npos) << summed.out;
    EXPECT_EQ(run("", {cornell(), "--divisor", "5"}).exit_code, 2);
}

TEST(Play, HelpNamesUnitsAndDefaults) {
    const Outcome outcome = run("", {"--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* words :
         {"1000000", "1280x720", "960x540", "EV100", "milliseconds", "beside the scene", "--ambiance", "--ies"})
        EXPECT_NE(outcome.out.find(words), std::string::npos) << words << " is not in\n" << outcome.out;
    EXPECT_EQ(run("", {}).exit_code, 2);
    EXPECT_EQ(run("", {cornell(), "--size", "wide"}).exit_code, 2);
}

TEST(Play, RefusesMalformedPathsInOneLine) {
    const TempFolder folder;
    for (const char* text :
         {"", "{}", "[]", R"({"keys": []})", R"({"keys": [3]})", R"({"keys": [{"time": 0}]})",
          R"({"keys": [{"time": 0, "position": [0, 1]}]})", R"({"keys": [{"time": "x", "position": [0, 1, 2]}]})",
          R"({"fps": 0, "keys": [{"time": 0, "position": [0, 1, 2]}]})",
          R"({"keys": [{"time": 1, "position": [0, 1, 2]}, {"time": 1, "position": [0, 1, 2]}]})"}) {
        write_text(folder / "path.json", text);
        const Outcome outcome = run("", {cornell(), "--play", folder / "path.json"});
        EXPECT_EQ(outcome.exit_code, 1) << text;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("path.json"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run("", {cornell(), "--frames", folder / "frames"}).exit_code, 2);
}

TEST(Play, PassesThroughItsKeysAndTurnsTheShorterWay) {
    const Scene scene = load_gltf(cornell());
    Path path;
    for (int i = 0; i < 4; ++i)
        path.keys.push_back({double(i), glm::dvec3(i * i, 1, -i), i % 2 ? -170.0 : 170.0, 5.0 * i});
    const Camera at = camera_on(path, 2, scene);
    EXPECT_LT(length(at.position + vec3(scene.origin) - vec3(4, 1, -2)), 1e-5f);
    const vec3 ahead = -camera_on(path, 0.5, scene).rotation[2];
    EXPECT_GT(ahead.z, 0.9f) << "between 170 and -170 degrees it looks back, not ahead";
    EXPECT_LT(length(camera_on(path, 99, scene).position + vec3(scene.origin) - vec3(9, 1, -3)), 1e-5f);
}

/// A walker of 30 cm could go where the walk of the sample room goes, at the height of the eyes, of a table and of a
/// seat.
TEST(Play, TheWalkOfTheSampleRoomPassesNoWall) {
    const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/apartment.glb");
    const RayCaster caster(scene);
    const Path path = load_path(LUMENWALK_SOURCE_DIR "/data/apartment.path.json");
    for (double t = 0; t < path.seconds(); t += 0.02)
        for (float down : {0.0f, 0.7f, 1.15f}) {
            const vec3 here = camera_on(path, t, scene).position - vec3(0, down, 0);
            const vec3 next = camera_on(path, t + 0.02, scene).position - vec3(0, down, 0);
            ASSERT_EQ(caster.transmittance(here, next), vec3(1)) << "at " << t << " s";
            for (float angle = 0; angle < 6; angle += 0.8f)
                ASSERT_EQ(caster.transmittance(here, here + 0.15f * vec3(std::cos(angle), 0, std::sin(angle))), vec3(1))
                    << "at " << t << " s, " << down << " m below the eyes";
        }
}

TEST(Bookmarks, ComeBackAsTheyWereSaved) {
    const TempFolder folder;
    const std::vector<Bookmark> saved{{"desk", {1.5, 2, -3e4}, 12.5f, -7, 60}, {"\"door\"", {0, 0, 0}, 0, 0, 0}};
    save_bookmarks(folder / "b.json", saved);
    const std::vector<Bookmark> loaded = load_bookmarks(folder / "b.json");
    ASSERT_EQ(loaded.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(loaded[i].name, saved[i].name);
        EXPECT_EQ(loaded[i].position, saved[i].position);
        EXPECT_EQ(loaded[i].yaw_deg, saved[i].yaw_deg);
    }
}

TEST(ViewTransition, StartsAndEndsWhereItShouldAndTurnsTheShorterWay) {
    ViewTransition transition;
    transition.from.yaw = 3, transition.to.yaw = -3;
    transition.to.eye = vec3(2, 0, 0);
    transition.seconds = 1;
    EXPECT_EQ(walker_at(transition).yaw, 3);
    transition.passed = 0.5f;
    EXPECT_NEAR(std::abs(walker_at(transition).yaw), lw_pi, 1e-3f);
    EXPECT_NEAR(walker_at(transition).eye.x, 1, 1e-5f);
    transition.passed = 1;
    EXPECT_EQ(walker_at(transition).eye, transition.to.eye);
}

}  // namespace
}  // namespace lw
