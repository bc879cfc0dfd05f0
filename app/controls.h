// What keys, mouse and gamepad mean.
#pragma once
#include "app/session/session.h"
#include "app/window/window.h"

namespace lw {

/// What the panels take for themselves at the moment.
struct PanelCapture {
    bool mouse = false, keyboard = false;
};

/// Movement asked for now: keys held, mouse moved, sticks pushed. `seconds` since the last frame.
WalkInput walk_input(const Window& window, const Events& events, PanelCapture capture, float seconds);

/// What keys, clicks and the wheel did, in their order: places, views, recording, quitting, ...; the mouse is captured,
/// a lamp selected and dimmed, the probe pinned (needs the map), a grid's corner chosen.
void apply_actions(Session& session, Window& window, const Events& events, PanelCapture capture, const PhotonMap* map);

/// What sticks and held buttons ask for: left stick walks, right stick looks, A and B up and down, a bumper is faster.
WalkInput gamepad_input(const Gamepad& pad, float seconds);

/// Buttons of the gamepad that were pressed: X flies, Y is the next view, Start hides the panels, the cross goes from
/// place to place and dims the selected lamp.
void apply_buttons(Session& session, const std::vector<int>& buttons);

}  // namespace lw
