// Devices that are lost, lack what is needed or run out of memory: a layer below the programs makes a good device fail
// (tests/faults/fault_layer.cpp). One line, exit status 1, nothing written.
#include <gtest/gtest.h>

#include "programs/command.h"
#include "programs/fault.h"
#include "programs/lavapipe.h"

namespace lw {
namespace {

using Words = std::vector<std::string>;

std::string scene_path() { return LUMENWALK_SOURCE_DIR "/data/cube.gltf"; }

/// A scene with its map; made once.
class FaultyDevice : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TempFolder>();
        const Outcome baked = run("bake", {scene_path(), "-o", *folder / "map", "--photons", "1000"});
        ASSERT_EQ(baked.exit_code, 0) << baked.err;
    }
    static void TearDownTestSuite() { folder.reset(); }

    static Outcome screenshot(const std::string& fault, const Words& more = {}) {
        const Fault in_force(fault);
        Words words{scene_path(), *folder / "map", "-o",        *folder / "picture.png",
                    "--size",     "16x12",         "--samples", "1",
                    "--gather",   "smooth",        "--device",  "llvmpipe"};
        words.insert(words.end(), more.begin(), more.end());
        return run("screenshot", words);
    }
    static void expect_refusal(const std::string& fault, const std::string& told, const Words& more = {}) {
        const Outcome outcome = screenshot(fault, more);
        EXPECT_EQ(outcome.exit_code, 1) << fault << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(told), std::string::npos) << fault << ": " << outcome.err;
        EXPECT_EQ(folder->names(), Words{"map"}) << fault;
    }

    static inline std::unique_ptr<TempFolder> folder;
};

TEST_F(FaultyDevice, WithoutAFaultMakesThePicture) {
    SKIP_WITHOUT_LAVAPIPE();
    const Outcome outcome = screenshot("none");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::remove(*folder / "picture.png"));
}

TEST_F(FaultyDevice, LostAtAnySubmissionIsToldInOneLine) {
    SKIP_WITHOUT_LAVAPIPE();
    int lost_at = 1;
    for (; lost_at < 200; lost_at = lost_at < 4 ? lost_at + 1 : lost_at * 3 / 2) {
        const Outcome outcome = screenshot("lost=" + std::to_string(lost_at));
        if (outcome.exit_code == 0) break;  // it takes no more submissions
        EXPECT_EQ(outcome.exit_code, 1) << lost_at << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("the device was lost"), std::string::npos) << lost_at << ": " << outcome.err;
        EXPECT_EQ(folder->names(), Words{"map"}) << lost_at;
    }
    EXPECT_GT(lost_at, 8);
    EXPECT_LT(lost_at, 200);
    std::filesystem::remove(*folder / "picture.png");
}

TEST_F(FaultyDevice, WithoutWhatIsNeededIsRefusedByTheNameOfItsLack) {
    SKIP_WITHOUT_LAVAPIPE();
    expect_refusal("limit=apiVersion:1002", "lacks Vulkan 1.3, has 1.2");
    for (const char* feature : {"scalarBlockLayout", "dynamicRendering", "synchronization2", "maintenance4"})
        expect_refusal(std::string("feature=") + feature, std::string("lacks feature ") + feature);
    expect_refusal("limit=maxPerStageDescriptorSampledImages:8", "binds 8 textures");
    expect_refusal("limit=maxTexelBufferElements:64", "one buffer holds at most");
    expect_refusal("limit=maxStorageBufferRange:16", "one buffer holds at most");
    expect_refusal("limit=maxImageDimension2D:8", "a picture of 16x12 is too large, the limit is 8x8");
}

TEST_F(FaultyDevice, WithTooLittleMemoryIsAskedFirstAndTellsWhatWouldFit) {
    SKIP_WITHOUT_LAVAPIPE();
    const std::string big = *folder / "big";
    ASSERT_EQ(run("bake", {scene_path(), "-o", big, "--photons", "300000"}).exit_code, 0);
    const auto refusal = [&](const std::string& fault, const Words& more) {
        const Fault in_force(fault);
        Words words{scene_path(), big, "-o", *folder / "picture.png", "--size", "16x12", "--device", "llvmpipe"};
        words.insert(words.end(), more.begin(), more.end());
        return run("screenshot", words);
    };
    for (const Outcome& outcome : {refusal("memory=4", {}), refusal("none", {"--device-memory", "0.004"})}) {
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_NE(outcome.err.find("MiB may be used (--device-memory); a map of "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("00 photons would fit"), std::string::npos) << outcome.err;
    }
    EXPECT_NE(refusal("none", {"--device-memory", "0.001"}).err.find("may be used"), std::string::npos);
    for (const char* senseless : {"0", "-1", "nan", "much"})
        EXPECT_EQ(refusal("none", {"--device-memory", senseless}).exit_code, 2) << senseless;
    // What was told to fit does.
    const std::string told = refusal("memory=4", {}).err;
    const size_t at = told.find("a map of ") + 9;
    const std::string count = told.substr(at, told.find(' ', at) - at);
    ASSERT_EQ(run("bake", {scene_path(), "-o", big, "--photons", count}).exit_code, 0);
    const Outcome fits = refusal("none", {"--device-memory", "0.0042"});
    EXPECT_EQ(fits.exit_code, 0) << fits.err;
    std::filesystem::remove(*folder / "picture.png");
    std::filesystem::remove(big);
}

TEST_F(FaultyDevice, WhoseMemoryEndsAtAnyAllocationIsToldInOneLine) {
    SKIP_WITHOUT_LAVAPIPE();
    int failed = 0;
    for (int n = 1; n < 400; n = n < 4 ? n + 1 : n * 3 / 2) {
        const Outcome outcome = screenshot("no-memory=" + std::to_string(n));
        if (outcome.exit_code == 0) break;
        ++failed;
        EXPECT_EQ(outcome.exit_code, 1) << n << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("no memory for "), std::string::npos) << n << ": " << outcome.err;
        EXPECT_EQ(folder->names(), Words{"map"}) << n;
    }
    EXPECT_GT(failed, 6);
    std::filesystem::remove(*folder / "picture.png");
}

}  // namespace
}  // namespace lw
