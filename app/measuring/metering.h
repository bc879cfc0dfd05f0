// Measuring in the window: the probe under the crosshair, pins, calculation grids, and their tables.
#pragma once
#include "app/session/session.h"

namespace lw {

/// Measures the point under the crosshair again and, with `all`, the pins.
void measure_again(Session& session, const Probe& probe, bool all);

/// Measures the point that the picture (`size` pixels) shows at `pixel`, and keeps it as a pin.
void pin_at(Session& session, const Probe& probe, vec2 pixel, vec2 size);

/// Writes the pins as a CSV file into the output folder; tells the user its name or the error.
void save_pins(Session& session);

/// Starts the choice of a grid's corners by clicks, or ends it.
void toggle_field_choice(Session& session);

/// Takes the point that the picture (`size` pixels) shows at `pixel` as the next corner. The second corner adds the
/// grid.
void choose_corner(Session& session, vec2 pixel, vec2 size);

/// Adds the grid written in the panel's input line, or tells the user what is wrong with it.
void add_written_field(Session& session);

/// Writes the grids as the CSV files that lumenwalk-measure writes; tells the user their names or the error.
void save_fields(Session& session);

}  // namespace lw
