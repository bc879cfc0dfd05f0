#include "app/controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "app/measuring/metering.h"
#include "app/panels/panels.h"
#include "app/session/actions.h"
#include "app/session/saving.h"

namespace lw {
namespace {

constexpr float radians_per_unit = 0.0022f;  // of mouse movement
constexpr float stick_radians_per_second = 2.4f;
constexpr float dead_zone = 0.15f;
constexpr float dimmer_step = 0.05f;

/// The position of a stick's axis: 0 near the middle, where sticks do not rest exactly, then linear to -1 and 1.
float stick(const Gamepad& pad, int axis) {
    const float value = std::clamp(pad.axes[size_t(axis)], -1.0f, 1.0f), beyond = std::abs(value) - dead_zone;
    return beyond > 0 ? std::copysign(beyond / (1 - dead_zone), value) : 0;
}

float held(const Window& window, std::initializer_list<int> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return window.is_down(key); }) ? 1.0f : 0.0f;
}

void toggle_flying(Session& s) {
    s.transition.reset();
    if (!s.walker.flying) {
        s.walker.flying = true;
        tell(s, "flying: Space and Ctrl go up and down", 2);
        return;
    }
    s.walker = land(s.walker, s.body, s.world.collision);
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

void dim_selected(Session& s, float by) {
    if (s.lighting.selected < 0) return;
    float& dimmer = s.lighting.lamps[size_t(s.lighting.selected)].dimmer;
    dimmer = std::clamp(dimmer + by, 0.0f, 2.0f);
}

/// Flies to the next camera or bookmark (`by` = 1) or the one before (-1).
void change_place(Session& s, int by) {
    const auto count = int(s.world.scene.cameras.size() + s.bookmarks.size());
    s.place = (s.place + by + count) % count;
    fly_to(s, size_t(s.place));
}

void apply_lamp_key(Session& s, int key) {
    if (s.lighting.selected < 0) return;
    LampState& lamp = s.lighting.lamps[size_t(s.lighting.selected)];
    if (key == GLFW_KEY_O) lamp.on = !lamp.on;
    if (key == GLFW_KEY_I) lamp.solo = !lamp.solo;
}

void apply_key(Session& s, Window& window, const KeyPress& press) {
    const int key = press.key;
    if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9 && !fly_to(s, size_t(key - GLFW_KEY_1)))
        tell(s, "no camera or bookmark " + std::to_string(key - GLFW_KEY_0), 2);
    switch (key) {
        case GLFW_KEY_ESCAPE:
            s.fields.chooses = false;
            return window.capture_mouse(false);
        case GLFW_KEY_F1:
            s.keys = !s.keys;
            return;
        case GLFW_KEY_F2:
            s.picture_request = PictureRequest::save;
            return;
        case GLFW_KEY_F3:
            s.picture_request = PictureRequest::copy;
            return;
        case GLFW_KEY_G:
            return toggle_field_choice(s);
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

void apply_click(Session& s, Window& window, const Click& click, const Probe* probe, vec2 size) {
    const vec2 at = window.is_captured() ? 0.5f * size : vec2(click.x, click.y);
    const int lamp = click.right || s.fields.chooses ? -1 : lamp_at(s, at, size);
    if (s.fields.chooses && !click.right) {
        choose_corner(s, at, size);
    } else if (lamp >= 0) {
        s.lighting.selected = lamp;
    } else if (probe && (click.right || (window.is_captured() && s.metering.on))) {
        pin_at(s, *probe, at, size);
    } else if (!click.right) {
        window.capture_mouse(true);
    }
}

}  // namespace

WalkInput walk_input(const Window& window, const Events& events, PanelCapture capture, float seconds) {
    WalkInput input;
    input.turn = -vec2(events.mouse_x, events.mouse_y) * radians_per_unit;
    if (!capture.keyboard) {
        input.move.x = held(window, {GLFW_KEY_D, GLFW_KEY_RIGHT}) - held(window, {GLFW_KEY_A, GLFW_KEY_LEFT});
        input.move.y = held(window, {GLFW_KEY_SPACE}) - held(window, {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL});
        input.move.z = held(window, {GLFW_KEY_W, GLFW_KEY_UP}) - held(window, {GLFW_KEY_S, GLFW_KEY_DOWN});
        input.fast = held(window, {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT}) > 0;
    }
    if (!events.gamepad) return input;
    const WalkInput pad = gamepad_input(*events.gamepad, seconds);
    return {input.move + pad.move, input.turn + pad.turn, input.fast || pad.fast};
}

void apply_actions(Session& s, Window& window, const Events& events, PanelCapture capture, const Probe* probe) {
    const vec2 size(float(events.size.width), float(events.size.height));
    for (const auto& action : events.actions) {
        if (const auto* press = std::get_if<KeyPress>(&action)) {
            if (!capture.keyboard || press->key == GLFW_KEY_F1 || press->key == GLFW_KEY_F11)
                apply_key(s, window, *press);
        } else if (capture.mouse) {
            continue;
        } else if (const auto* click = std::get_if<Click>(&action)) {
            apply_click(s, window, *click, probe, size);
        } else {
            dim_selected(s, dimmer_step * std::get<Scroll>(action).turns);
        }
    }
}

WalkInput gamepad_input(const Gamepad& pad, float seconds) {
    const auto down = [&](int button) { return pad.buttons[size_t(button)]; };
    WalkInput input;
    input.move = vec3(stick(pad, GLFW_GAMEPAD_AXIS_LEFT_X),
                      float(down(GLFW_GAMEPAD_BUTTON_A)) - float(down(GLFW_GAMEPAD_BUTTON_B)),
                      -stick(pad, GLFW_GAMEPAD_AXIS_LEFT_Y));
    input.turn = -vec2(stick(pad, GLFW_GAMEPAD_AXIS_RIGHT_X), stick(pad, GLFW_GAMEPAD_AXIS_RIGHT_Y)) *
                 (stick_radians_per_second * seconds);
    input.fast = down(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER) || down(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER);
    return input;
}

void apply_buttons(Session& s, const std::vector<int>& buttons) {
    for (int button : buttons) {
        if (button == GLFW_GAMEPAD_BUTTON_X) toggle_flying(s);
        if (button == GLFW_GAMEPAD_BUTTON_Y) change_view(s, 1);
        if (button == GLFW_GAMEPAD_BUTTON_START) s.panels = !s.panels;
        if (button == GLFW_GAMEPAD_BUTTON_DPAD_LEFT) change_place(s, -1);
        if (button == GLFW_GAMEPAD_BUTTON_DPAD_RIGHT) change_place(s, 1);
        if (button == GLFW_GAMEPAD_BUTTON_DPAD_UP) dim_selected(s, dimmer_step);
        if (button == GLFW_GAMEPAD_BUTTON_DPAD_DOWN) dim_selected(s, -dimmer_step);
    }
}

}  // namespace lw
