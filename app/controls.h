// What keys, mouse and gamepad mean.
#pragma once
#include "app/session.h"
#include "app/window.h"

namespace lw {

/// What the panels take for themselves at the moment.
struct Taken {
    bool mouse = false, keyboard = false;
};

/// Movement asked for now: keys held, mouse moved, sticks pushed. `seconds` since the last frame.
WalkInput walk_input(const Window& window, const Events& events, Taken taken, float seconds);

/// Keys that were pressed: places, views, recording, quitting, ... Wheel turns dim the selected lamp.
void apply_keys(Session& session, Window& window, const Events& events, Taken taken, float wheel);

/// Clicks: capture the mouse, select a lamp, pin the probe (needs the map).
void apply_clicks(Session& session, Window& window, const Events& events, Taken taken, const PhotonMap* map);

/// Buttons of the gamepad that were pressed since the last call: fly, next view, panels.
void apply_gamepad(Session& session);

}  // namespace lw
