// The four programs as their users meet them: help, refusals in one line, whole files or none, Ctrl-C.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <sstream>
#include <thread>

#include "programs/command_lines.h"
#include "programs/lavapipe.h"

namespace lw::test {
namespace {

class EachProgram : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Programs, EachProgram, testing::Values("bake", "screenshot", "reference", "compare"),
                         [](const auto& program) { return program.param; });

TEST_P(EachProgram, HelpNamesUnitsAndDefaults) {
    const std::map<std::string, Words> promised = {
        {"bake", {"metres", "degrees", "1000000", "beside the scene", "60", "--seed", "--threads"}},
        {"screenshot", {"cd/m2", "lux", "EV100", "300", "smooth", "beside the scene", "LIGHT=FACTOR"}},
        {"reference", {"cd/m2", "lux", "seconds", "960x540", "default: 256", "LIGHT=FACTOR"}},
        {"compare", {"cd/m2", "lux", "20 %", "--json"}}};
    const Outcome outcome = run(GetParam(), {"--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    for (const std::string& words : promised.at(GetParam()))
        EXPECT_TRUE(contains(outcome.out, words)) << words << " is not in\n" << outcome.out;
}

TEST_P(EachProgram, ExitsWith2OnAnUnknownOptionAndNamesIt) {
    const TempFolder folder;
    Words words = command_line(GetParam(), scene_path("cube.gltf"), folder / "made");
    words.push_back("--brightness");
    const Outcome outcome = run(GetParam(), words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(contains(outcome.err, "--brightness")) << outcome.err;
    EXPECT_EQ(folder.names(), Words{});
}

TEST_P(EachProgram, ExitsWith2WithoutArguments) {
    const Outcome outcome = run(GetParam(), {});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err, "");
}

TEST_P(EachProgram, RefusesWhatIsNoSceneOrPictureInOneLineAndWritesNothing) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "folder");
    write_text(folder / "empty", "");
    write_text(folder / "prose", "It was a dark and stormy night.\nThe rain fell in torrents.\n");
    const Words before = folder.names();
    for (const char* input : {"missing", "folder", "empty", "prose"})
        expect_refusal(run(GetParam(), command_line(GetParam(), folder / input, folder / "made")), input);
    EXPECT_EQ(folder.names(), before);
}

TEST_P(EachProgram, RefusesAnOutputThatCannotBeCreatedInOneLine) {
    if (GetParam() == "screenshot") SKIP_WITHOUT_LAVAPIPE();
    const TempFolder folder;
    std::string input = scene_path("cube.gltf");
    if (GetParam() == "screenshot") {
        std::filesystem::copy_file(input, folder / "cube.gltf");
        input = folder / "cube.gltf";
        bake(input, input + ".pmap");
    }
    if (GetParam() == "compare") {
        input = folder / "picture.exr";
        expect_success(run("reference", {scene_path("cube.gltf"), "-o", input, "--size", "8x8", "--samples", "1"}));
    }
    write_text(folder / "file", "");
    for (const char* extension : {".pmap", ".png", ".exr"})
        std::filesystem::create_directory(folder / "dir" + extension);
    const Words before = folder.names();
    for (const char* place : {"missing/made", "file/made", "dir", "/proc/made"})
        expect_refusal(run(GetParam(), command_line(GetParam(), input, folder / place)), folder / place);
    EXPECT_EQ(folder.names(), before);
}

TEST(CommandLine, IsRefusedWith2WhenAValueMakesNoSense) {
    const TempFolder folder;
    const std::string scene = scene_path("cube.gltf"), png = folder / "made.png", exr = folder / "made.exr";
    const std::vector<std::pair<std::string, Words>> senseless = {
        {"bake", {scene, "-o", folder / "made.pmap", "--radius", "wide"}},
        {"bake", {scene, "-o", folder / "made.pmap", "--radius", "-1"}},
        {"bake", {scene, "-o", folder / "made.pmap", "--photons", "0"}},
        {"bake", {scene, "-o", folder / "made.pmap", "--neighbour-angle", "120"}},
        {"screenshot", {scene, "-o", folder / "made.jpg"}},
        {"screenshot", {scene, "-o", png, "--size", "10by10"}},
        {"screenshot", {scene, "-o", png, "--power", "lamp"}},
        {"screenshot", {scene, "-o", png, "--gather", "quick"}},
        {"screenshot", {"--list-lights"}},
        {"reference", {scene, "-o", png}},
        {"reference", {scene, "-o", exr, "--size", "0x10"}},
        {"reference", {scene, "-o", exr, "--size", "4294967297x8"}},
        {"reference", {scene, "-o", exr, "--seed", "-1"}},
        {"bake", {scene, "-o", folder / "made.pmap", "--seed", "99999999999999999999"}},
        {"screenshot", {scene, "-o", png, "--size", "+8x8"}},
        {"reference", {scene, "-o", exr, "--power", "lamp"}},
        {"reference", {scene, "-o", exr, "--samples", "0"}},
        {"reference", {scene, "-o", exr, "--time", "-1"}},
        {"reference", {scene, "-o", exr, "--error", "0"}},
        {"compare", {exr}},
    };
    for (const auto& [program, words] : senseless) {
        const Outcome outcome = run(program, words);
        EXPECT_EQ(outcome.exit_code, 2) << program << " ... " << words.back() << "\n" << outcome.err;
        EXPECT_NE(outcome.err, "");
    }
    EXPECT_EQ(folder.names(), Words{});
}

TEST(CommandLine, TakesOnlyOneWordForAPowerSoThatTheSceneMayFollow) {
    for (const char* program : {"screenshot", "reference"}) {
        const Outcome outcome = run(program, {"-o", "unused.exr", "--power", "lamp=2", "missing.gltf"});
        expect_refusal(outcome, "missing.gltf: cannot be opened");
    }
}

TEST(Bake, WritesBesideTheSceneByDefault) {
    const TempFolder folder;
    std::filesystem::copy_file(scene_path("cube.gltf"), folder / "cube.gltf");
    const Outcome outcome = run("bake", {folder / "cube.gltf", "--photons", "1000"});
    expect_success(outcome);
    EXPECT_EQ(folder.names(), (Words{"cube.gltf", "cube.pmap"}));
    EXPECT_TRUE(contains(outcome.out, "wrote " + (folder / "cube.pmap"))) << outcome.out;
}

TEST(Bake, WritesTheSameBytesOnOneAndTwoThreads) {
    const TempFolder folder;
    for (const char* scene : {"cornell.gltf", "apartment.glb"}) {
        for (const char* threads : {"1", "2"})
            bake(scene_path(scene), folder / threads, {"--photons", "20000", "--threads", threads});
        const std::string one = read_text(folder / "1");
        EXPECT_GT(one.size(), 20000u);
        EXPECT_TRUE(one == read_text(folder / "2")) << scene;
    }
}

TEST(Bake, WritesOtherBytesForAnotherSeed) {
    const TempFolder folder;
    for (const char* seed : {"1", "2"})
        bake(scene_path("cube.gltf"), folder / seed, {"--photons", "1000", "--seed", seed});
    EXPECT_FALSE(read_text(folder / "1") == read_text(folder / "2"));
}

/// Lines "photons 10 % (2.5e+06/s, 4 s left)", then one that says why the program ended.
void expect_plain_progress(const std::string& err) {
    EXPECT_EQ(err.find_first_of("\r\x1b"), std::string::npos);
    std::istringstream stream(err);
    Words lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    ASSERT_GE(lines.size(), 2u) << err;
    EXPECT_EQ(lines.back(), "lumenwalk-bake: interrupted: nothing was written");
    lines.pop_back();
    for (const std::string& line : lines) {
        EXPECT_TRUE(line.starts_with("photons ") && line.ends_with(" s left)")) << line;
        EXPECT_TRUE(contains(line, " % (") && contains(line, "/s, ")) << line;
    }
}

TEST(Bake, TellsProgressInPlainLinesAndLeavesTheOldMapWhenInterrupted) {
    const TempFolder folder;
    write_text(folder / "old.pmap", "the map of yesterday");
    Process process("bake", {scene_path("cube.gltf"), "-o", folder / "old.pmap", "--photons", "20000000"});
    const auto start = std::chrono::steady_clock::now();
    while (count_lines(process.err_so_far()) == 0 && std::chrono::steady_clock::now() - start < std::chrono::minutes(1))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    process.interrupt();
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    expect_plain_progress(outcome.err);
    EXPECT_EQ(read_text(folder / "old.pmap"), "the map of yesterday");
    EXPECT_EQ(folder.names(), Words{"old.pmap"});
}

TEST(Screenshot, RefusesTheMapOfAnotherOrAChangedScene) {
    const TempFolder folder;
    bake(scene_path("cube.gltf"), folder / "cube.pmap");
    expect_refusal(run("screenshot", {scene_path("cornell.gltf"), folder / "cube.pmap", "-o", folder / "made.png"}),
                   "the scene cornell.gltf has changed since this map was baked, or the map is of another scene");
    const std::string changed = edited_scene(folder, "cube.gltf", "0.5,", "0.6,");
    expect_refusal(run("screenshot", {changed, folder / "cube.pmap", "-o", folder / "made.png"}),
                   "the scene cube.gltf has changed");
    EXPECT_EQ(folder.names(), (Words{"cube.gltf", "cube.pmap"}));
}

TEST(Screenshot, RefusesADamagedMapAndSaysThatTheMapChanged) {
    const TempFolder folder;
    bake(scene_path("cube.gltf"), folder / "cube.pmap");
    std::string bytes = read_text(folder / "cube.pmap");
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    write_text(folder / "cube.pmap", bytes);
    expect_refusal(run("screenshot", {scene_path("cube.gltf"), folder / "cube.pmap", "-o", folder / "made.png"}),
                   "the map file has changed");
}

TEST(Screenshot, WithoutAMapTellsHowToMakeOne) {
    const TempFolder folder;
    std::filesystem::copy_file(scene_path("cube.gltf"), folder / "cube.gltf");
    expect_refusal(run("screenshot", {folder / "cube.gltf", "-o", folder / "made.png"}), "lumenwalk-bake");
    EXPECT_EQ(folder.names(), Words{"cube.gltf"});
}

TEST(Screenshot, ListsCamerasLampsAndDevices) {
    EXPECT_EQ(run("screenshot", {scene_path("apartment.glb"), "--list-cameras"}).out, "living\nkitchen\ncorridor\n");
    EXPECT_EQ(run("screenshot", {scene_path("cornell.gltf"), "--list-lights"}).out, "ceiling_lamp\n");
    std::string devices;
    for (const std::string& name : device_names()) devices += name + "\n";
    const Outcome outcome = run("screenshot", {"--list-devices"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, devices);
}

TEST(Screenshot, RefusesAnUnknownCameraOrDeviceWithTheNamesThereAre) {
    const TempFolder folder;
    bake(scene_path("cube.gltf"), folder / "map");
    const Words words{scene_path("cube.gltf"), folder / "map", "-o", folder / "made.png"};
    Words camera = words, device = words;
    camera.insert(camera.end(), {"--camera", "outside"});
    device.insert(device.end(), {"--device", "abacus"});
    expect_refusal(run("screenshot", camera), "there are: inside");
    expect_refusal(run("screenshot", device), device_names().empty() ? "no device" : device_names()[0]);
    EXPECT_EQ(folder.names(), Words{"map"});
}

TEST(Compare, RefusesPicturesOfDifferentSizeNamingBoth) {
    const TempFolder folder;
    for (const char* size : {"8x8", "8x9"})
        expect_success(run("reference", {scene_path("cube.gltf"), "-o", folder / size + std::string(".exr"), "--size",
                                         size, "--samples", "1"}));
    const Outcome outcome =
        run("compare", {folder / "8x8.exr", folder / "8x9.exr", "--difference", folder / "difference.png"});
    expect_refusal(outcome, folder / "8x8.exr");
    EXPECT_TRUE(contains(outcome.err, "8x9")) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.names(), (Words{"8x8.exr", "8x9.exr"}));
}

}  // namespace
}  // namespace lw::test
