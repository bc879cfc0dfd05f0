// The window's frames, driven one at a time: how soon an input is seen.
#include "app/picture/viewer.h"

#include "app/display.h"
#include "maps/bake.h"

namespace lw {
namespace {

size_t different_pixels(const Rgb8Image& a, const Rgb8Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixel_count(); ++i)
        count += !std::equal(a.rgb.begin() + long(3 * i), a.rgb.begin() + long(3 * i + 3), b.rgb.begin() + long(3 * i));
    return count;
}

TEST(Viewer, WhatTheUserDoesIsOnTheScreenWithinTwoFrames) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const World world(LUMENWALK_SOURCE_DIR "/data/cornell.gltf", {}, {});
    const auto map = std::make_shared<const PhotonMap>(bake(world.scene, world.caster, {.photons = 10'000}));
    const TempFolder folder;
    Session session(world, folder.path());
    session.viewing.auto_exposure = false;
    Window window("Lumenwalk - latency", {640, 400});
    Viewer viewer(window, session, {"llvmpipe", true, {}}, false);
    viewer.set_map(map);
    for (int i = 0; i < 60; ++i) viewer.frame(std::nullopt);
    xdotool("search --sync --name 'Lumenwalk - latency' windowfocus --sync");
    for (int i = 0; i < 5; ++i) viewer.frame(std::nullopt);
    for (const char* key : {"h", "v", "h", "v"}) {  // panels go, false colours come, ...
        pause_ms(200);
        const Rgb8Image before = display.screen();
        xdotool(std::string("key ") + key);
        int frames = 0;
        while (frames < 8 && different_pixels(before, display.screen()) < 2000) {
            viewer.frame(std::nullopt);
            ++frames;
            pause_ms(150);  // the display's part
        }
        EXPECT_GE(frames, 1) << key;
        EXPECT_LE(frames, 2) << key;
    }
    EXPECT_EQ(viewer.device().validation_messages(), std::vector<std::string>{});
}

TEST(Viewer, APictureThatIsNoLightIsNotSaved) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const World world(LUMENWALK_SOURCE_DIR "/data/cube.gltf", {}, {});
    PhotonMap map = bake(world.scene, world.caster, {.photons = 2'000});
    const TempFolder folder;
    Session session(world, folder.path());
    Window window("Lumenwalk - no light", {64, 48});
    Viewer viewer(window, session, {"llvmpipe", true, {}}, false);
    const auto save = [&] {
        for (int i = 0; i < 4; ++i) viewer.frame(std::nullopt);
        session.picture_request = PictureRequest::save;
        for (int i = 0; i < 4; ++i) viewer.frame(std::nullopt);
        return session.notice.text;
    };
    viewer.set_map(std::make_shared<const PhotonMap>(map));
    EXPECT_NE(save().find("cube-001.png and cube-001.exr"), std::string::npos) << session.notice.text;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube-001.exr", "cube-001.png"}));
    map.irradiance_scale = 0x1p-127f;  // light is divided by it
    map.flux_scale = 0x1p-127f;
    viewer.set_map(std::make_shared<const PhotonMap>(map));
    EXPECT_NE(save().find("is not written: "), std::string::npos) << session.notice.text;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube-001.exr", "cube-001.png"}));
}

}  // namespace
}  // namespace lw
