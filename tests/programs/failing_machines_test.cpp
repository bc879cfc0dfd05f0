// The programs where something goes wrong around them: killed at any moment, a full disk, two writers of one file,
// outputs that are inputs, numbers that are none, too little memory.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "programs/command_lines.h"

namespace lw::test {
namespace {

/// While it lives, files of this process and those it starts end at `bytes`, as on a full disk.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(FailingMachines, ABakeEndedAtAnyMomentLeavesTheOldMapAndNothingElse) {
    const TempFolder folder;
    write_text(folder / "old.pmap", "the map of yesterday");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        for (const int ms : {1, 10, 30, 60, 100, 150, 200, 300, 400}) {
            Process process("bake", {scene_path("cube.gltf"), "-o", folder / "old.pmap", "--photons", "20000000"});
            std::this_thread::sleep_for(std::chrono::milliseconds(ms));
            process.send(signal);
            EXPECT_EQ(process.wait().exit_code, 128 + signal) << ms << " ms";
            EXPECT_EQ(read_text(folder / "old.pmap"), "the map of yesterday");
            EXPECT_EQ(folder.names(), Words{"old.pmap"}) << ms << " ms, signal " << signal;
        }
}

TEST(FailingMachines, AnInterruptWhileAFileIsHalfWrittenRemovesIt) {
    const TempFolder folder;
    Process reference("reference", {scene_path("cube.gltf"), "-o", folder / "picture.exr", "--size", "64x64"});
    reference.send(SIGTERM);
    EXPECT_EQ(reference.wait().exit_code, 143);

    Process baking("bake", {scene_path("cube.gltf"), "-o", folder / "map", "--photons", "2000000"});
    const auto start = std::chrono::steady_clock::now();
    const auto is_writing = [&] {
        for (const std::string& name : folder.names()) {
            std::error_code gone;  // it may get its final name meanwhile
            const auto size = std::filesystem::file_size(folder / name, gone);
            if (contains(name, "partial") && !gone && size > 0) return true;
        }
        return false;
    };
    while (!is_writing() && !std::filesystem::exists(folder / "map") &&
           std::chrono::steady_clock::now() - start < std::chrono::minutes(2))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    baking.send(SIGTERM);
    baking.wait();
    for (const std::string& name : folder.names()) EXPECT_EQ(name, "map");  // when it was faster than this test
}

TEST(FailingMachines, AKilledBakeDoesNotHinderTheNext) {
    const TempFolder folder;
    {
        Process process("bake", {scene_path("cube.gltf"), "-o", folder / "map", "--photons", "20000000"});
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        process.send(SIGKILL);
        EXPECT_EQ(process.wait().exit_code, 137);
    }
    write_text(folder / "map.partial-1-0", "left behind by a power cut");
    EXPECT_EQ(run("bake", {scene_path("cube.gltf"), "-o", folder / "map", "--photons", "1000"}).exit_code, 0);
}

TEST(FailingMachines, AFullDiskIsToldInOneLineAndTheOldFileStays) {
    const TempFolder folder;
    const std::string scene = scene_path("cube.gltf");
    ASSERT_EQ(run("bake", {scene, "-o", folder / "map", "--photons", "1000"}).exit_code, 0);
    const std::string before = read_text(folder / "map");
    {
        const FullDisk disk(4096);
        expect_refusal(run("bake", {scene, "-o", folder / "map", "--photons", "5000"}), "is the disk full?");
        expect_refusal(run("reference", {scene, "-o", folder / "picture.exr", "--size", "64x64", "--samples", "1"}),
                       "picture.exr: cannot be written");
    }
    EXPECT_EQ(read_text(folder / "map"), before);
    EXPECT_EQ(folder.names(), Words{"map"});
}

TEST(FailingMachines, TwoBakesOfOneSceneAtOnceBothEndWell) {
    const TempFolder folder;
    const Words words{scene_path("cube.gltf"), "-o", folder / "map", "--photons", "50000"};
    Process first("bake", words), second("bake", words);
    EXPECT_EQ(first.wait().exit_code, 0);
    EXPECT_EQ(second.wait().exit_code, 0);
    EXPECT_EQ(folder.names(), Words{"map"});
    ASSERT_EQ(run("bake", {words[0], "-o", folder / "alone", "--photons", "50000"}).exit_code, 0);
    EXPECT_TRUE(read_text(folder / "map") == read_text(folder / "alone"));
}

TEST(FailingMachines, NoProgramWritesOverItsInput) {
    const TempFolder folder;
    const std::string scene = folder / "cube.exr", linked = folder / "link.exr";  // the loader looks at the content
    std::filesystem::copy_file(scene_path("cube.gltf"), scene);
    std::filesystem::create_symlink(scene, linked);
    const std::string before = read_text(scene);
    for (const std::string& output : {scene, linked}) {
        expect_refusal(run("bake", {scene, "-o", output, "--photons", "100"}), "is an input");
        expect_refusal(run("reference", {scene, "-o", output, "--size", "8x8", "--samples", "1"}), "is an input");
    }
    ASSERT_EQ(run("bake", {scene, "-o", folder / "map.exr", "--photons", "100"}).exit_code, 0);
    const std::string map = read_text(folder / "map.exr");
    expect_refusal(run("screenshot", {scene, folder / "map.exr", "-o", folder / "map.exr"}), "is an input");
    expect_refusal(run("screenshot", {scene, folder / "map.exr", "-o", scene}), "is an input");
    EXPECT_EQ(read_text(scene), before);
    EXPECT_EQ(read_text(folder / "map.exr"), map);
    const std::string picture = folder / "picture.png";
    ASSERT_EQ(run("reference", {scene, "-o", folder / "a.exr", "--size", "8x8", "--samples", "1"}).exit_code, 0);
    std::filesystem::rename(folder / "a.exr", picture);
    expect_refusal(run("compare", {picture, picture, "--difference", picture}), "is an input");
}

TEST(FailingMachines, MeasureWritesOverNoInputAndNoFileTwice) {
    const TempFolder folder;
    std::filesystem::copy_file(scene_path("cube.gltf"), folder / "cube.gltf");
    const std::string scene = folder / "cube.gltf", points = folder / "points.csv", walk = folder / "walk.json";
    write_text(points, "desk,0.5,-1,0.5\n");
    write_text(walk, R"({"fps": 1, "keys": [{"time": 0, "position": [0, 0, 0.8]}]})");
    ASSERT_EQ(run("bake", {scene, "--photons", "1000"}).exit_code, 0);
    const auto measured = [&](Words more) {
        Words words{scene, "--points", points};
        words.insert(words.end(), more.begin(), more.end());
        return run("measure", words);
    };
    const std::vector<std::string> before{read_text(scene), read_text(points), read_text(walk),
                                          read_text(folder / "cube.pmap")};
    for (const char* option : {"--csv", "--fields-csv", "--report"})
        for (const std::string& input : {scene, points, folder / "cube.pmap", folder / "cube.ambiances.json"})
            expect_refusal(measured({option, input}), "is an input");
    expect_refusal(measured({"--photons", "1000", "--save-map", points}), "is an input");
    expect_refusal(measured({"--reflections", walk, "--reflections-csv", walk}), "is an input");
    expect_refusal(measured({"--csv", folder / "a", "--report", folder / "./a"}), "written twice");
    expect_refusal(measured({"--photons", "1000", "--save-map", folder / "b", "--csv", folder / "b"}), "written twice");
    expect_refusal(run("", {scene, "--play", walk, "--size", "16x16", "--timings", folder / "cube.pmap"}),
                   "is an input");
    EXPECT_EQ(before, (std::vector<std::string>{read_text(scene), read_text(points), read_text(walk),
                                                read_text(folder / "cube.pmap")}));
    EXPECT_EQ(folder.names(), (Words{"cube.gltf", "cube.pmap", "points.csv", "walk.json"}));
}

TEST(FailingMachines, GridsAndAmbiancesOfOneNameAreRefused) {
    const std::string scene = scene_path("cube.gltf"), grid = "desk: -0.5,-0.5,-0.5 to 0.5,-0.5,0.5";
    const auto measured = [&](Words more) {
        Words words{scene, "--photons", "1000", "--grid", grid};
        words.insert(words.end(), more.begin(), more.end());
        return run("measure", words);
    };
    expect_refusal(measured({"--grid", grid}), "--grid \"desk\": there are two of this name");
    expect_refusal(measured({"--ambiance", "dim: lamp=0.5", "--ambiance", "dim: lamp=0.2"}),
                   "--ambiance \"dim\": there are two of this name");
    EXPECT_EQ(measured({"--ambiance", "dim: lamp=0.5", "--ambiance", "day: lamp=1"}).exit_code, 0);
}

TEST(FailingMachines, APhotometricFileIsAnInputToo) {
    const TempFolder folder;
    const std::string file = folder / "lamp.ies";
    std::filesystem::copy_file(scene_path("photometry/flood.ies"), file);
    const std::string before = read_text(file);
    expect_refusal(run("bake", {scene_path("cube.gltf"), "--ies", "lamp=" + file, "-o", file, "--photons", "100"}),
                   "is an input");
    EXPECT_EQ(read_text(file), before);
}

TEST(FailingMachines, AFileThatMayNotGrowIsToldLikeAFullDisk) {
    const TempFolder folder;
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);  // without ignoring the signal that this sends
    const Outcome outcome = run("bake", {scene_path("cube.gltf"), "-o", folder / "map", "--photons", "5000"});
    setrlimit(RLIMIT_FSIZE, &before);
    expect_refusal(outcome, "is the disk full?");
    EXPECT_EQ(folder.names(), Words{});
}

TEST(FailingMachines, OptionsThatAreNoNumberAreRefusedWith2) {
    const std::string scene = scene_path("cube.gltf");
    for (const char* value : {"nan", "inf", "-inf", "1e999", "", "1m"}) {
        EXPECT_EQ(run("bake", {scene, "-o", "/nowhere/x", "--neighbour-angle", value}).exit_code, 2) << value;
        EXPECT_EQ(run("bake", {scene, "-o", "/nowhere/x", "--radius", value}).exit_code, 2) << value;
        EXPECT_EQ(run("bake", {scene, "-o", "/nowhere/x", "--memory", value}).exit_code, 2) << value;
        EXPECT_EQ(run("screenshot", {scene, "-o", "/nowhere/x.png", "--exposure", value}).exit_code, 2) << value;
        EXPECT_EQ(run("reference", {scene, "-o", "/nowhere/x.exr", "--time", value}).exit_code, 2) << value;
        EXPECT_EQ(run("reference", {scene, "-o", "/nowhere/x.exr", "--error", value}).exit_code, 2) << value;
    }
}

/// A variable of the environment while it lives; programs started meanwhile see it.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { before_.empty() ? unsetenv(name_) : setenv(name_, before_.c_str(), 1); }

  private:
    const char* name_;
    std::string before_;
};

TEST(FailingMachines, WithoutVulkanOrItsLayersOneLineSaysWhatToInstall) {
    const TempFolder folder;
    const std::string scene = scene_path("cube.gltf");
    ASSERT_EQ(run("bake", {scene, "-o", folder / "map", "--photons", "1000"}).exit_code, 0);
    const Words words{scene, folder / "map", "-o", folder / "made.png", "--size", "8x8"};
    {
        const Variable drivers("VK_ICD_FILENAMES", "/nowhere.json"), newer("VK_DRIVER_FILES", "/nowhere.json");
        const Outcome outcome = run("screenshot", words);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(contains(outcome.err, "lumenwalk-screenshot: Vulkan:")) << outcome.err;
        EXPECT_EQ(run("screenshot", {"--list-devices"}).exit_code, 0);
    }
    const Variable layers("VK_LAYER_PATH", "/nowhere");
    Words checked = words;
    checked.push_back("--validation");
    EXPECT_TRUE(contains(run("screenshot", checked).err, "is not installed (vulkan-validationlayers)"));
    EXPECT_EQ(folder.names(), Words{"map"});
}

TEST(FailingMachines, AnOddEnvironmentChangesNothing) {
    const TempFolder folder;
    const std::string scene = scene_path("cube.gltf");
    ASSERT_EQ(run("bake", {scene, "-o", folder / "plain", "--photons", "1000"}).exit_code, 0);
    const Variable locale("LC_ALL", "de_DE.UTF-8"), home("HOME", "/nowhere");
    ASSERT_EQ(run("bake", {scene, "-o", folder / "odd", "--photons", "1000"}).exit_code, 0);
    EXPECT_TRUE(read_text(folder / "plain") == read_text(folder / "odd"));
}

}  // namespace
}  // namespace lw::test
