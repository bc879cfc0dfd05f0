// Measuring in the window: the probe under the crosshair, pins, calculation grids, and their tables.
#pragma once
#include "app/session/session.h"

namespace lw {

/// Measures again what lies under the crosshair and, when `all`, the pins.
void measure_again(Session& session, const PhotonMap& map, bool all);

/// Measures and pins what the picture shows at a pixel.
void pin_at(Session& session, const PhotonMap& map, vec2 pixel, vec2 size);

/// The pins as a table beside the other outputs; tells how it went.
void save_pins(Session& session);

/// Begins to choose the corners of a calculation grid, or gives up.
void toggle_field_choice(Session& session);

/// Takes what the picture shows at a pixel as the next corner; the second one makes the grid.
void choose_corner(Session& session, vec2 pixel, vec2 size);

/// Adds the grid of the panel's line; tells what is wrong with it.
void add_written_field(Session& session);

/// The grids as tables of lumenwalk-measure; tells how it went.
void save_fields(Session& session);

}  // namespace lw
