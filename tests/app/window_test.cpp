// lumenwalk in a real window, driven by keys and mouse; any Vulkan validation message fails the test.
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/display.h"
#include "image/exr.h"
#include "image/png.h"
#include "programs/fault.h"

namespace lw {
namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;

double mean_of(const Image& image, const char* channel) {
    double sum = 0;
    for (float v : image.find(channel)->values) sum += double(v);
    return sum / double(image.pixel_count());
}

/// Position of the newest bookmark, after B has been pressed.
std::array<double, 3> bookmark(const WalkingWindow& window, const std::string& file, size_t count) {
    window.key("b");
    Json bookmarks;
    EXPECT_TRUE(wait_until([&] {
        bookmarks = Json::parse(read_text(window.folder() / file), nullptr, false);
        return bookmarks.is_object() && bookmarks["bookmarks"].size() == count;
    }));
    return bookmarks["bookmarks"].back()["position"].get<std::array<double, 3>>();
}

size_t resident_kilobytes(pid_t process) {
    const std::string status = read_text("/proc/" + std::to_string(process) + "/status");
    return std::stoul(status.substr(status.find("VmRSS:") + 6));
}

void expect_clean_end(const Outcome& outcome) { EXPECT_EQ(outcome.exit_code, 0) << outcome.err; }

TEST(Window, BakesTheMissingMapShowsItAndDimsALampAsPowerDoes) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cornell.gltf", {"--photons", "150000"});
    ASSERT_TRUE(window.waits_for("baking one"));
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(window.folder() / "cornell.pmap"); }));
    const auto both_maps_are_told = [&] {
        const std::string told = window.process().err_so_far();
        const size_t preview = told.find(" photons\n");
        return preview != std::string::npos && told.find(" photons\n", preview + 1) != std::string::npos;
    };
    ASSERT_TRUE(wait_until(both_maps_are_told));
    pause_ms(2500);       // the full map is taken up: pipelines are made anew
    window.screenshot();  // and they are there
    window.key("h");      // the panels cover so small a window
    window.screenshot();
    xdotool("mousemove --window " + window.id() + " 160 35 click 1");  // the ceiling lamp
    pause_ms(500);
    const Image full = read_exr(window.screenshot() + ".exr");
    for (int i = 0; i < 10; ++i) xdotool("click 5");  // the wheel, 5 % a turn
    pause_ms(1000);
    const Image half = read_exr(window.screenshot() + ".exr");
    for (const char* channel : {"R", "G", "B", "illuminance"})
        EXPECT_NEAR(mean_of(half, channel), 0.5 * mean_of(full, channel), 0.003 * mean_of(full, channel)) << channel;
    const std::string scene = window.folder() / "cornell.gltf", expected = window.folder() / "expected.exr";
    ASSERT_EQ(
        run("screenshot", {scene, "-o", expected, "--size", "320x240", "--power", "ceiling_lamp=0.5", "--samples", "8"})
            .exit_code,
        0);
    EXPECT_NEAR(mean_of(half, "illuminance"), mean_of(read_exr(expected), "illuminance"),
                0.02 * mean_of(half, "illuminance"));
    expect_clean_end(window.close());
}

TEST(Window, AClickCountsWhereItFellHoweverLateTheFrameIs) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    xdotool("windowsize " + window.id() + " 800 600");
    pause_ms(1000);
    const double full = mean_of(read_exr(window.screenshot() + ".exr"), "illuminance");
    xdotool("mousemove --window " + window.id() + " 30 100");  // on a panel, which takes what is clicked there
    pause_ms(1000);
    ASSERT_EQ(kill(window.process().id(), SIGSTOP), 0);
    std::string words =
        "mousemove --window " + window.id() + " 400 88 click 1";  // the ceiling lamp, between the panels
    for (int i = 0; i < 10; ++i) words += " click 5";
    xdotool(words);
    ASSERT_EQ(kill(window.process().id(), SIGCONT), 0);
    pause_ms(1000);
    EXPECT_NEAR(mean_of(read_exr(window.screenshot() + ".exr"), "illuminance"), 0.5 * full, 0.01 * full);
    expect_clean_end(window.close());
}

TEST(Window, WalkingIntoEveryWallStaysInTheRoom) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cube.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    const std::array<double, 3> start = bookmark(window, "cube.bookmarks.json", 1);
    xdotool("mousemove --window " + window.id() + " 160 200 click 1");  // captures the mouse
    double farthest = 0;
    for (size_t turn = 0; turn < 5; ++turn) {
        xdotool("keydown shift keydown w");
        pause_ms(900);
        xdotool("keyup w keyup shift mousemove_relative -- 650 5");
        pause_ms(200);
        const std::array<double, 3> at = bookmark(window, "cube.bookmarks.json", turn + 2);
        for (double coordinate : at) EXPECT_LT(std::abs(coordinate), 2) << turn;
        farthest = std::max(farthest, std::hypot(at[0] - start[0], at[2] - start[2]));
    }
    EXPECT_GT(farthest, 0.5) << "it did not walk";
    window.key("Escape");
    expect_clean_end(window.close());
}

TEST(Window, SurvivesAHundredSizesHidingAndFullScreenWithoutLeak) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cube.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    const auto resize = [&](int first, int end) {
        std::string words;
        for (int i = first; i < end; ++i)
            words += " windowsize " + window.id() + " " + std::to_string(200 + i % 10 * 13) + " " +
                     std::to_string(150 + i % 7 * 11) + " sleep 0.04";
        xdotool(words.substr(1));
    };
    resize(0, 30);
    size_t before = 0;  // once all pipelines are made
    EXPECT_TRUE(wait_until([&] {
        const size_t last = before;
        pause_ms(1000);
        before = resident_kilobytes(window.process().id());
        return double(before) < 1.01 * double(last);
    }));
    resize(30, 100);
    xdotool("windowunmap " + window.id() + " sleep 0.3 windowmap " + window.id() + " windowfocus " + window.id());
    window.key("F11");
    pause_ms(300);
    window.key("F11");
    pause_ms(500);
    resize(28, 30);
    pause_ms(500);
    EXPECT_LT(double(resident_kilobytes(window.process().id())), 1.25 * double(before) + 20'000);
    const Rgb8Image shown = read_png(window.screenshot() + ".png");
    EXPECT_EQ(shown.width, 200 + 29 % 10 * 13);
    EXPECT_EQ(shown.height, 150 + 29 % 7 * 11);
    expect_clean_end(window.close());
}

TEST(Window, GoesThroughAllViewsAndTogglesWithoutValidationMessages) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    for (const char* keys : {"x", "v", "l", "v",           "k",         "v",  "v", "v", "v", "v",
                             "v", "v", "p", "bracketleft", "backslash", "F1", "r", "1", "f", "9"}) {
        window.key(keys);
        pause_ms(150);
    }
    xdotool("mousemove --window " + window.id() + " 160 170 click 3");
    window.key("r");
    EXPECT_TRUE(window.waits_for("walk saved")) << window.process().err_so_far();
    EXPECT_TRUE(window.says("no camera or bookmark 9"));
    expect_clean_end(window.close());
}

TEST(Window, GoesOnWithAMapThatCannotBeSavedAndRefusesToOverwriteAMalformedFile) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const std::string malformed = "{\"bookmarks\": [3]}";
    WalkingWindow window("cube.gltf", {"/proc/cube.pmap", "--photons", "5000"}, malformed);
    EXPECT_TRUE(window.waits_for("/proc/cube.pmap: "));
    EXPECT_TRUE(window.waits_for("; the map is used, but not kept"));
    window.key("b");
    EXPECT_TRUE(window.waits_for("cube.bookmarks.json: bookmarks: every entry must be an object; put it right"));
    EXPECT_EQ(read_text(window.folder() / "cube.bookmarks.json"), malformed);
    const Image picture = read_exr(window.screenshot() + ".exr");
    EXPECT_GT(mean_of(picture, "illuminance"), 0);
    expect_clean_end(window.close());
}

TEST(Window, EndsWithOneLineWhenItsDisplayGoesAway) {
    SKIP_WITHOUT_DISPLAY();
    Display display;
    WalkingWindow window("cube.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    const auto lines = [&] {
        const std::string said = window.process().err_so_far();
        return std::count(said.begin(), said.end(), '\n');
    };
    const auto before = lines();
    display.vanish();
    const Outcome outcome = window.wait();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), before + 1) << outcome.err;
    EXPECT_EQ(window.folder().names(), (Words{"cube.gltf", "cube.pmap", "photometry", "window"}));
}

TEST(Window, GoesOnWhenItsDeviceIsLostAndGivesUpWhenItIsLostAgain) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    {
        const Fault fault("lost-once=60");
        WalkingWindow window("cube.gltf", {"--photons", "5000"});
        ASSERT_TRUE(window.waits_for("the graphics device was lost: starting it again"));
        const Image picture = read_exr(window.screenshot() + ".exr");
        EXPECT_GT(mean_of(picture, "illuminance"), 0);
        expect_clean_end(window.close());
    }
    const Fault fault("lost=60");
    WalkingWindow window("cube.gltf", {"--photons", "5000"});
    const Outcome outcome = window.wait();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("lumenwalk: Vulkan: the graphics device was lost twice within a minute\n"),
              std::string::npos)
        << outcome.err;
}

TEST(Window, SaysInOneLineThatThereIsNoDisplay) {
    SKIP_WITHOUT_LAVAPIPE();
    unsetenv("DISPLAY");
    const Outcome outcome = run("", {"data/cube.gltf"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("no display"), std::string::npos) << outcome.err;
}

TEST(Window, SaysInOneLineThatThereIsNoVulkan) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) setenv(name, "/nowhere.json", 1);
    const Outcome outcome = run("", {"data/cube.gltf"});
    for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) unsetenv(name);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("lumenwalk: Vulkan: no device found (mesa-vulkan-drivers"), std::string::npos)
        << outcome.err;
}

TEST(Window, GoesOnWithoutABrokenFileOfAmbiancesAndLeavesItAlone) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cube.gltf", {"--photons", "5000"}, "", "{\"ambiances\": 3");
    ASSERT_TRUE(window.waits_for(" photons\n"));
    EXPECT_TRUE(window.says("cube.ambiances.json: is not JSON"));
    EXPECT_GT(mean_of(read_exr(window.screenshot() + ".exr"), "illuminance"), 0);
    expect_clean_end(window.close());
    EXPECT_EQ(read_text(window.folder() / "cube.ambiances.json"), "{\"ambiances\": 3");
}

TEST(Window, ACalculationGridByTwoClicksIsReadAndAFileOnALampBakesAnew) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cube.gltf", {"--photons", "5000"}, "",
                         R"({"photometry": {"lamp": "photometry/batwing.ies"}})");
    ASSERT_TRUE(window.waits_for(" photons\n"));
    window.key("h");
    window.key("g");
    EXPECT_TRUE(window.waits_for("click two opposite corners"));
    xdotool("mousemove --window " + window.id() + " 40 200 click 1");
    EXPECT_TRUE(window.waits_for("now the opposite corner"));
    xdotool("mousemove --window " + window.id() + " 280 230 click 1");
    EXPECT_TRUE(window.waits_for("grid 1: "));
    EXPECT_TRUE(window.waits_for("calculation grids: 1 read"));
    expect_clean_end(window.close());
    EXPECT_EQ(run("screenshot", {window.folder() / "cube.gltf", "-o", window.folder() / "a.png", "--size", "16x16"})
                  .exit_code,
              0)
        << "the map belongs to the scene with the file, for every program";
}

}  // namespace
}  // namespace lw
