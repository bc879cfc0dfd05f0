// The window's frames, driven one at a time: how soon an input is seen.
#include "app/show.h"

#include "app/display.h"
#include "maps/build.h"
#include "photons/shoot.h"

namespace lw {
namespace {

size_t different_pixels(const Rgb8Image& a, const Rgb8Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixel_count(); ++i)
        count += !std::equal(a.rgb.begin() + long(3 * i), a.rgb.begin() + long(3 * i + 3), b.rgb.begin() + long(3 * i));
    return count;
}

TEST(Show, WhatTheUserDoesIsOnTheScreenWithinTwoFrames) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const World world(LUMENWALK_SOURCE_DIR "/data/cornell.gltf", {});
    const auto map = std::make_shared<const PhotonMap>(build_photon_map(
        world.scene, world.caster, shoot_photons(world.scene, world.caster, {10'000, 1}), {10'000, 0, 60, 1}));
    const TempFolder folder;
    Session session(world, folder.path());
    session.viewing.auto_exposure = false;
    Window window("Lumenwalk - latency", {640, 400});
    Show show(window, session, {"llvmpipe", true, {}}, false);
    show.set_map(map);
    for (int i = 0; i < 60; ++i) show.frame(std::nullopt);
    xdotool("search --sync --name 'Lumenwalk - latency' windowfocus --sync");
    for (int i = 0; i < 5; ++i) show.frame(std::nullopt);
    for (const char* key : {"h", "v", "h", "v"}) {  // panels go, false colours come, ...
        pause_ms(200);
        const Rgb8Image before = display.screen();
        xdotool(std::string("key ") + key);
        int frames = 0;
        while (frames < 8 && different_pixels(before, display.screen()) < 2000) {
            show.frame(std::nullopt);
            ++frames;
            pause_ms(150);  // the display's part
        }
        EXPECT_GE(frames, 1) << key;
        EXPECT_LE(frames, 2) << key;
    }
    EXPECT_EQ(show.device().validation_messages(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lw
