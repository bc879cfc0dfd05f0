// Lamps dimmed by --power: as if the scene had other lamps, and what is refused.
#include <gtest/gtest.h>

#include "image/exr.h"
#include "programs/command_lines.h"
#include "programs/lavapipe.h"

namespace lw::test {
namespace {

TEST(Power, OfAnUnknownLampIsRefusedWithTheNamesThereAre) {
    const TempFolder folder;
    for (const char* program : {"screenshot", "reference"}) {
        Words words = command_line(program, scene_path("cornell.gltf"), folder / "made");
        words.insert(words.end(), {"--power", "moon=2"});
        const Outcome outcome = run(program, words);
        expect_refusal(outcome, "moon");
        EXPECT_TRUE(contains(outcome.err, "ceiling_lamp")) << outcome.err;
    }
    EXPECT_EQ(folder.names(), Words{});
}

TEST(Power, WithAFactorThatIsNoneIsRefused) {
    for (const char* factor : {"", "much", "-1", "nan", "2x"})
        expect_refusal(
            run("screenshot", {scene_path("cube.gltf"), "-o", "unused.png", "--power", std::string("lamp=") + factor}),
            "--power lamp=");
}

/// R, G, B and illuminance of a small picture from a fresh map.
Image baked_picture(const TempFolder& folder, const std::string& scene, const Words& more) {
    bake(scene, folder / "map", {"--photons", "20000"});
    Words words{scene,      folder / "map", "-o", folder / "picture.exr", "--size", "32x24", "--device",
                "llvmpipe", "--samples",    "1",  "--validation"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run("screenshot", words);
    if (outcome.exit_code != 0) throw Error(outcome.err);
    return read_exr(folder / "picture.exr");
}

struct DoubledLamp {
    const char *scene, *lamp, *strength, *doubled;
};

void PrintTo(const DoubledLamp& lamp, std::ostream* out) { *out << lamp.scene; }

class Doubling : public testing::TestWithParam<DoubledLamp> {};

INSTANTIATE_TEST_SUITE_P(Lamps, Doubling,
                         testing::Values(DoubledLamp{"cube.gltf", "lamp", "\"intensity\": 100", "\"intensity\": 200"},
                                         DoubledLamp{"cornell.gltf", "ceiling_lamp", "\"emissiveStrength\": 1000",
                                                     "\"emissiveStrength\": 2000"}),
                         [](const auto& lamp) { return lamp.param.lamp; });

TEST_P(Doubling, ALampByPowerEqualsASceneWithTwiceTheLamp) {
    SKIP_WITHOUT_LAVAPIPE();
    const TempFolder folder;
    const DoubledLamp& lamp = GetParam();
    const Image once = baked_picture(folder, scene_path(lamp.scene), {});
    const Image by_power = baked_picture(folder, scene_path(lamp.scene), {"--power", std::string(lamp.lamp) + "=2"});
    const Image by_scene = baked_picture(folder, edited_scene(folder, lamp.scene, lamp.strength, lamp.doubled), {});
    for (const char* channel : {"R", "G", "B", "illuminance"}) {
        for (size_t i = 0; i < once.pixel_count(); ++i) {
            const float expected = by_scene.find(channel)->values[i];
            ASSERT_NEAR(by_power.find(channel)->values[i], expected, 1e-5f * expected) << channel << " " << i;
            ASSERT_NEAR(2 * once.find(channel)->values[i], expected, 1e-5f * expected) << channel << " " << i;
        }
    }
}

}  // namespace
}  // namespace lw::test
