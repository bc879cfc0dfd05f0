// What gamepads and pointers mean, from plain values: no window, no device.
#include "app/controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace lw {
namespace {

struct Building {
    Building() : world(LUMENWALK_SOURCE_DIR "/data/apartment.glb", {}, {}), session(world, "") {}
    World world;
    Session session;
};

Gamepad with_axis(int axis, float value) {
    Gamepad pad;
    pad.axes[size_t(axis)] = value;
    return pad;
}

Gamepad with_button(int button) {
    Gamepad pad;
    pad.buttons[size_t(button)] = true;
    return pad;
}

TEST(Gamepad, LeftStickWalksAndRightStickLooksTheWayItIsPushed) {
    EXPECT_EQ(gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_LEFT_X, 1), 0.1f).move, vec3(1, 0, 0)) << "to the right";
    EXPECT_EQ(gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_LEFT_Y, -1), 0.1f).move, vec3(0, 0, 1)) << "away: ahead";
    EXPECT_LT(gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_RIGHT_X, 1), 0.1f).turn.x, 0) << "turn is positive to the left";
    EXPECT_GT(gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_RIGHT_Y, -1), 0.1f).turn.y, 0) << "away: upwards";
    EXPECT_EQ(gamepad_input(with_button(GLFW_GAMEPAD_BUTTON_A), 0.1f).move.y, 1);
    EXPECT_EQ(gamepad_input(with_button(GLFW_GAMEPAD_BUTTON_B), 0.1f).move.y, -1);
    EXPECT_TRUE(gamepad_input(with_button(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER), 0.1f).fast);
    EXPECT_FALSE(gamepad_input({}, 0.1f).fast);
}

TEST(Gamepad, SticksAtRestDoNothingAndBeyondGrowWithoutAJump) {
    for (float rest : {-0.14f, 0.0f, 0.08f, 0.15f})
        EXPECT_EQ(gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_LEFT_X, rest), 0.1f).move, vec3(0)) << rest;
    float before = 0;
    for (float x = 0.1f; x <= 1; x += 0.02f) {
        const float now = gamepad_input(with_axis(GLFW_GAMEPAD_AXIS_LEFT_X, x), 0.1f).move.x;
        EXPECT_GE(now, before);
        EXPECT_LT(now - before, 0.04f) << "jumps at " << x;
        before = now;
    }
}

TEST(Gamepad, TurnsTheSameAngleInASecondAtAnyFrameRate) {
    const Gamepad pad = with_axis(GLFW_GAMEPAD_AXIS_RIGHT_X, 0.6f);
    float slow = 0, fast = 0;
    for (int i = 0; i < 10; ++i) slow += gamepad_input(pad, 0.1f).turn.x;
    for (int i = 0; i < 100; ++i) fast += gamepad_input(pad, 0.01f).turn.x;
    EXPECT_NEAR(slow, fast, 1e-4f);
}

TEST(Gamepad, AButtonCountsOnceHoweverLongItIsHeld) {
    const Gamepad up, down = with_button(GLFW_GAMEPAD_BUTTON_X);
    EXPECT_EQ(newly_pressed(down, up), std::vector<int>{GLFW_GAMEPAD_BUTTON_X});
    EXPECT_TRUE(newly_pressed(down, down).empty());
    EXPECT_TRUE(newly_pressed(up, down).empty());
}

TEST(Gamepad, ButtonsFlyChangeTheViewHidePanelsJumpAndDim) {
    Building b;
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_X});
    EXPECT_TRUE(b.session.walker.flying);
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_Y});
    EXPECT_EQ(b.session.viewing.view, view_illuminance);
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_START});
    EXPECT_FALSE(b.session.panels);
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT});
    ASSERT_TRUE(b.session.transition);
    EXPECT_EQ(b.session.transition->to.eye, b.world.scene.cameras[1].position);
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, GLFW_GAMEPAD_BUTTON_DPAD_LEFT});
    EXPECT_EQ(b.session.transition->to.eye, b.world.scene.cameras.back().position) << "round to the last";
    b.session.lighting.selected = 2;
    apply_buttons(b.session, {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN});
    EXPECT_NEAR(b.session.lighting.lamps[2].dimmer, 0.9f, 1e-5f);
}

TEST(Pointer, PointsAtPixelsOfAFineScreen) {
    const Click fine = click_at(100, 50, {320, 240}, {640, 480}, false);
    EXPECT_EQ(vec2(fine.x, fine.y), vec2(200, 100));
    const Click odd = click_at(160, 120, {320, 240}, {480, 360}, true);
    EXPECT_EQ(vec2(odd.x, odd.y), vec2(240, 180));
    EXPECT_TRUE(odd.right);
    const Click hidden = click_at(3, 4, {0, 0}, {0, 0}, false);
    EXPECT_EQ(vec2(hidden.x, hidden.y), vec2(0, 0));
}

}  // namespace
}  // namespace lw
