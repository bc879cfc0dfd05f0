// What changes a session while the user walks: time that passes, jumps to places, lamps that fade. No files.
#pragma once
#include "app/session/session.h"

namespace lw {

/// Shows a line for a while, and prints it.
void tell(Session& session, const std::string& text, double seconds = 5);

/// Lights the lamps, fading from what is lit now.
void fade_to(Lighting& lighting, const LampStates& lamps);

/// Flies to place `index`: the cameras of the scene, then the bookmarks. False when there is none.
bool fly_to(Session& session, size_t index);

/// From now on advance() keeps the walk in session.recording.
void start_recording(Session& session);

/// Moves on by `seconds`: transition or walk, crossfade, recording.
void advance(Session& session, const WalkInput& input, float seconds);

}  // namespace lw
