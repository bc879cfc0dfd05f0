// Photometric files on lamps in the walkthrough: what the panel tells of them, and that they stay with the scene.
#include "app/session/luminaire.h"
#include "app/session/saving.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/session/lamp_states.h"
#include "app/session/session.h"
#include "programs/command.h"
#include "scene/load_scene.h"

namespace lw {
namespace {

std::string cube() { return LUMENWALK_SOURCE_DIR "/data/cube.gltf"; }
std::string file_of(const char* name) { return LUMENWALK_SOURCE_DIR "/data/photometry/" + std::string(name); }

TEST(Luminaire, TellsFluxAndShapeOfTheFile) {
    const World world(cube(), {}, {"lamp=" + file_of("downlight.ies")});
    ASSERT_EQ(world.luminaires.size(), 1u);
    const Luminaire& luminaire = world.luminaires.at(0);
    EXPECT_NEAR(luminaire.unit_flux, 2 * lw_pi / 9, 0.002f);                   // cos^8
    EXPECT_NEAR(std::stod(luminaire.summary), 698.1, 2) << luminaire.summary;  // the file has a value per degree
    for (float gamma : {0.0f, 20.0f, 45.0f, 80.0f, 120.0f}) {
        const float expected = gamma < 90 ? std::pow(std::cos(gamma * lw_pi / 180), 8.0f) : 0.0f;
        EXPECT_NEAR(share_of_profile(world.scene, world.scene.lights[0], gamma, 77), expected, 0.01f) << gamma;
    }
    EXPECT_NE(power_text(world.scene.lights[0], 0.5f, luminaire.unit_flux).find("500 cd, 349"), std::string::npos)
        << power_text(world.scene.lights[0], 0.5f, luminaire.unit_flux);
}

TEST(Luminaire, ShowsBothPlanesOfALampThatIsNotRound) {
    const World world(cube(), {}, {"lamp=" + file_of("washer.ldt")});
    const Light& lamp = world.scene.lights[0];
    EXPECT_GT(share_of_profile(world.scene, lamp, 45, 0), 1.5f * share_of_profile(world.scene, lamp, 45, 180));
    const Luminaire& luminaire = world.luminaires.at(0);
    EXPECT_NE(luminaire.summary.find("light output ratio 80 %"), std::string::npos) << luminaire.summary;
    EXPECT_NE(luminaire.summary.find("3000 K"), std::string::npos) << luminaire.summary;
}

TEST(Luminaire, StaysWithTheSceneForEveryProgram) {
    const TempFolder folder;
    std::filesystem::copy_file(cube(), folder / "cube.gltf");
    std::filesystem::copy_file(file_of("downlight.ies"), folder / "downlight.ies");
    const World world(folder / "cube.gltf", {}, {});
    Session session = open_session(world, folder.path());
    attach_file(session, 0, "nothing.ies");
    EXPECT_FALSE(session.reload);
    EXPECT_NE(session.notice.text.find("nothing.ies"), std::string::npos);
    attach_file(session, 0, "downlight.ies");
    EXPECT_TRUE(session.reload);
    const Scene scene = load_scene(folder / "cube.gltf", {});
    EXPECT_EQ(scene.lights[0].type, light_profile);
    EXPECT_EQ(run("bake", {folder / "cube.gltf", "--photons", "2000"}).exit_code, 0);
    std::string reason;
    const World with_file(folder / "cube.gltf", session.lighting.presets, {});
    EXPECT_TRUE(try_load_map(folder / "cube.pmap", with_file.scene, reason)) << reason;
    EXPECT_FALSE(try_load_map(folder / "cube.pmap", world.scene, reason)) << "a map of other lamps";
    attach_file(session, 0, "");
    EXPECT_EQ(load_scene(folder / "cube.gltf", {}).lights[0].type, light_point);
}

TEST(Luminaire, AnotherFileOfTheOptionReplacesTheOneKept) {
    LampPresets presets;
    presets.photometry = {{"a", "one.ies"}, {"b", "two.ies"}};
    EXPECT_EQ(photometry_texts(presets, "/rooms/hall.glb", {"b=other.ldt"}),
              (std::vector<std::string>{"a=/rooms/one.ies", "b=other.ldt"}));
}

TEST(Luminaire, TheSameSessionGoesOnInTheBuildingWithOtherLamps) {
    const World before(cube(), {}, {}), after(cube(), {}, {"lamp=" + file_of("batwing.ies")});
    Session session(before, "");
    session.walker.eye += vec3(0.3f, 0, 0.2f);
    session.lighting.lamps[0].dimmer = 0.4f;
    session.viewing.view = view_illuminance;
    const Session next(after, session);
    EXPECT_EQ(&next.world, &after);
    EXPECT_EQ(next.walker.eye, session.walker.eye);
    EXPECT_EQ(next.lighting.lamps[0].dimmer, 0.4f);
    EXPECT_EQ(next.viewing.view, view_illuminance);
    EXPECT_FALSE(next.reload);
}

}  // namespace
}  // namespace lw
