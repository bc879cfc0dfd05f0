#include "app/controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "app/panels.h"

namespace lw {
namespace {

constexpr float radians_per_unit = 0.0022f;  // of mouse movement
constexpr float stick_radians_per_second = 2.4f;
constexpr float dead_zone = 0.15f;

std::optional<GLFWgamepadstate> gamepad() {
    GLFWgamepadstate state;
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id)
        if (glfwJoystickIsGamepad(id) && glfwGetGamepadState(id, &state)) return state;
    return std::nullopt;
}

float stick(const GLFWgamepadstate& pad, int axis) {
    const float value = pad.axes[axis];
    return std::abs(value) < dead_zone ? 0 : value - std::copysign(dead_zone, value);
}

float held(const Window& window, std::initializer_list<int> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return window.is_down(key); }) ? 1.0f : 0.0f;
}

void add_gamepad(WalkInput& input, float seconds) {
    const std::optional<GLFWgamepadstate> pad = gamepad();
    if (!pad) return;
    const auto down = [&](int button) { return pad->buttons[button] == GLFW_PRESS; };
    input.move += vec3(stick(*pad, GLFW_GAMEPAD_AXIS_LEFT_X),
                       float(down(GLFW_GAMEPAD_BUTTON_A)) - float(down(GLFW_GAMEPAD_BUTTON_B)),
                       -stick(*pad, GLFW_GAMEPAD_AXIS_LEFT_Y));
    input.turn -= vec2(stick(*pad, GLFW_GAMEPAD_AXIS_RIGHT_X), stick(*pad, GLFW_GAMEPAD_AXIS_RIGHT_Y)) *
                  (stick_radians_per_second * seconds);
    input.fast = input.fast || down(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER) || down(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER);
}

void toggle_flying(Session& s) {
    s.flight.reset();
    if (!s.walker.flying) {
        s.walker.flying = true;
        tell(s, "flying: Space and Ctrl go up and down", 2);
        return;
    }
    s.walker = land(s.walker, s.body, s.world.around);
    tell(s, s.walker.flying ? "no floor below: flying on" : "walking", 2);
}

void change_view(Session& s, int by) {
    s.viewing.view = uint(int(s.viewing.view + view_count) + by) % view_count;
    if (is_signed_view(s.viewing.view) && !s.comparison.on) change_view(s, by);
}

void change_exposure(Session& s, float by) {
    s.viewing.auto_exposure = false;
    s.viewing.exposure_ev += by;
}

void apply_lamp_key(Session& s, int key) {
    if (s.lighting.selected < 0) return;
    LampState& lamp = s.lighting.board[size_t(s.lighting.selected)];
    if (key == GLFW_KEY_O) lamp.on = !lamp.on;
    if (key == GLFW_KEY_I) lamp.solo = !lamp.solo;
}

void apply_key(Session& s, Window& window, const KeyPress& press) {
    const int key = press.key;
    if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9 && !fly_to(s, size_t(key - GLFW_KEY_1)))
        tell(s, "no camera or bookmark " + std::to_string(key - GLFW_KEY_0), 2);
    switch (key) {
        case GLFW_KEY_ESCAPE:
            return window.capture_mouse(false);
        case GLFW_KEY_F1:
            s.keys = !s.keys;
            return;
        case GLFW_KEY_F2:
            s.screenshot = true;
            return;
        case GLFW_KEY_F11:
            return window.toggle_full_screen();
        case GLFW_KEY_H:
            s.panels = !s.panels;
            return;
        case GLFW_KEY_F:
            return toggle_flying(s);
        case GLFW_KEY_P:
            s.metering.on = !s.metering.on;
            return;
        case GLFW_KEY_B:
            return add_bookmark(s);
        case GLFW_KEY_R:
            return toggle_recording(s);
        case GLFW_KEY_V:
            return change_view(s, press.shift ? -1 : 1);
        case GLFW_KEY_L:
            s.viewing.lines = !s.viewing.lines;
            return;
        case GLFW_KEY_K:
            s.viewing.logarithmic = !s.viewing.logarithmic;
            return;
        case GLFW_KEY_X:
            s.comparison.on = !s.comparison.on;
            return;
        case GLFW_KEY_LEFT_BRACKET:
            return change_exposure(s, 0.5f);
        case GLFW_KEY_RIGHT_BRACKET:
            return change_exposure(s, -0.5f);
        case GLFW_KEY_BACKSLASH:
            s.viewing.auto_exposure = true;
            return;
        case GLFW_KEY_Q:
            if (press.control) window.close();
            return;
        default:
            apply_lamp_key(s, key);
    }
}

}  // namespace

WalkInput walk_input(const Window& window, const Events& events, Taken taken, float seconds) {
    WalkInput input;
    input.turn = -vec2(events.mouse_x, events.mouse_y) * radians_per_unit;
    if (!taken.keyboard) {
        input.move.x = held(window, {GLFW_KEY_D, GLFW_KEY_RIGHT}) - held(window, {GLFW_KEY_A, GLFW_KEY_LEFT});
        input.move.y = held(window, {GLFW_KEY_SPACE}) - held(window, {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL});
        input.move.z = held(window, {GLFW_KEY_W, GLFW_KEY_UP}) - held(window, {GLFW_KEY_S, GLFW_KEY_DOWN});
        input.fast = held(window, {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT}) > 0;
    }
    add_gamepad(input, seconds);
    return input;
}

void apply_keys(Session& s, Window& window, const Events& events, Taken taken, float wheel) {
    for (const KeyPress& press : events.keys)
        if (!taken.keyboard || press.key == GLFW_KEY_F1 || press.key == GLFW_KEY_F11) apply_key(s, window, press);
    if (wheel == 0 || taken.mouse || s.lighting.selected < 0) return;
    float& dimmer = s.lighting.board[size_t(s.lighting.selected)].dimmer;
    dimmer = std::clamp(dimmer + 0.05f * wheel, 0.0f, 2.0f);
}

void apply_clicks(Session& s, Window& window, const Events& events, Taken taken, const PhotonMap* map) {
    for (const Click& click : events.clicks) {
        if (taken.mouse) continue;
        const vec2 size(float(events.size.width), float(events.size.height));
        const vec2 at = window.is_captured() ? 0.5f * size : vec2(click.x, click.y);
        const int lamp = click.right ? -1 : lamp_at(s, at, size);
        if (lamp >= 0) {
            s.lighting.selected = lamp;
        } else if (map && (click.right || (window.is_captured() && s.metering.on))) {
            pin_at(s, *map, at, size);
        } else if (!click.right) {
            window.capture_mouse(true);
        }
    }
}

void apply_gamepad(Session& s) {
    static GLFWgamepadstate before{};  // of the one gamepad that is read
    const std::optional<GLFWgamepadstate> pad = gamepad();
    if (!pad) return;
    const auto pressed = [&](int button) {
        return pad->buttons[button] == GLFW_PRESS && before.buttons[button] != GLFW_PRESS;
    };
    if (pressed(GLFW_GAMEPAD_BUTTON_X)) toggle_flying(s);
    if (pressed(GLFW_GAMEPAD_BUTTON_Y)) change_view(s, 1);
    if (pressed(GLFW_GAMEPAD_BUTTON_START)) s.panels = !s.panels;
    before = *pad;
}

}  // namespace lw
