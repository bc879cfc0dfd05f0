// What a bake is said to take against what it takes: the peak memory that lumenwalk-bake prints.
#include "maps/bake_memory.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.h"
#include "base/memory.h"
#include "programs/command.h"
#include "scene/gltf.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

double measured_bytes(const std::string& scene, uint64_t photons, const std::string& radius) {
    const TempFolder folder;
    const Outcome outcome = run(
        "bake", {file_in_data(scene), "-o", folder / "map", "--photons", std::to_string(photons), "--radius", radius});
    double megabytes = 0;
    const size_t at = outcome.out.find("peak memory ");
    if (at == std::string::npos || std::sscanf(outcome.out.c_str() + at, "peak memory %lf", &megabytes) != 1)
        throw Error(outcome.err);
    return megabytes * 1048576;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool takes_its_own_memory = false;  // sanitizers take more
#else
constexpr bool takes_its_own_memory = true;
#endif

TEST(BakeMemory, IsPredictedWithinAFactor) {
    if (!takes_its_own_memory) GTEST_SKIP() << "a sanitizer takes more memory";
    struct Case {
        const char* scene;
        uint64_t photons;
        float radius;
    };
    for (const Case& c :
         {Case{"cube.gltf", 1'000'000, 0}, {"cornell.gltf", 300'000, 0.04f}, {"apartment.glb", 100'000, 0}}) {
        const Scene scene = load_gltf(file_in_data(c.scene));
        const RayCaster caster(scene);
        const double predicted = double(predict_bake_bytes(scene, caster, {c.photons, c.radius, 60, 1}));
        const double taken =
            measured_bytes(c.scene, c.photons, c.radius > 0 ? std::to_string(c.radius) : std::string("auto"));
        EXPECT_LE(taken, predicted) << c.scene;
        EXPECT_GE(taken, 0.4 * predicted) << c.scene;
    }
}

TEST(BakeMemory, ThatIsToldIsOfTheBakeAloneHoweverMuchHoldsWhatStartedIt) {
    const std::vector<char> held(400'000'000, 1);
    EXPECT_LT(measured_bytes("cube.gltf", 1000, "auto"), 2e8) << held.back();
}

TEST(BakeMemory, ThatIsTooMuchIsRefusedAtTheStartWithWhatWouldFit) {
    const TempFolder folder;
    const Outcome outcome =
        run("bake", {file_in_data("cube.gltf"), "-o", folder / "map", "--photons", "64000000", "--memory", "5"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("5.0 GB may be used (--memory); 40000000 would fit"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
    EXPECT_EQ(
        run("bake", {file_in_data("cube.gltf"), "-o", folder / "map", "--photons", "1000", "--memory", "8"}).exit_code,
        0);
}

TEST(BakeMemory, CountsBeyond32BitsAreRefusedWhateverTheMemory) {
    const Scene scene = load_gltf(file_in_data("cube.gltf"));
    const RayCaster caster(scene);
    const auto message = [&](uint64_t photons, float radius) {
        try {
            check_bake_fits(scene, caster, {photons, radius, 60, 1}, uint64_t(1) << 60);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(message(2'000'000'000, 0).find("2^32 references"), std::string::npos) << message(2'000'000'000, 0);
    EXPECT_NE(message(1000, 1e-4f).find("larger --radius"), std::string::npos) << message(1000, 1e-4f);
    EXPECT_EQ(message(1'000'000'000, 0), "");
}

TEST(Memory, IsAvailableAndNamedInPowersOfTen) {
    EXPECT_GT(available_memory(), uint64_t(1) << 20);
    EXPECT_EQ(bytes_text(12'300'000), "12 MB");
    EXPECT_EQ(bytes_text(3'440'000'000), "3.4 GB");
}

}  // namespace
}  // namespace lw
