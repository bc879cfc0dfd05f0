// Turns keys, mouse and gamepad into movement and changes of the session.
#pragma once
#include "app/session/session.h"
#include "app/window/window.h"

namespace lw {

/// True members: the panels use the mouse or the keyboard now, so the walk must ignore it.
struct PanelCapture {
    bool mouse = false, keyboard = false;
};

/// The movement that held keys, the mouse and the gamepad's sticks ask for. `seconds`: since the last frame.
WalkInput walk_input(const Window& window, const Events& events, PanelCapture capture, float seconds);

/// Applies pressed keys, clicks and turns of the wheel to session and window, in the order they came. `probe` pins
/// what it reads; null before there is a map.
void apply_actions(Session& session, Window& window, const Events& events, PanelCapture capture, const Probe* probe);

/// The movement that a gamepad asks for: the left stick walks, the right one looks, A and B move up and down, a bumper
/// is faster.
WalkInput gamepad_input(const Gamepad& pad, float seconds);

/// Applies newly pressed buttons of the gamepad: X toggles flying, Y shows the next view, Start hides the panels, the
/// cross goes from place to place and dims the selected lamp.
void apply_buttons(Session& session, const std::vector<int>& buttons);

}  // namespace lw
