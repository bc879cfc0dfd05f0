// The panels and marks drawn over the picture with Dear ImGui. They read and write the session and nothing else.
#pragma once
#include "app/baking.h"
#include "app/measuring/reflection_search.h"
#include "app/session/session.h"

namespace lw {

/// The panel of lamps: search, dimmers, switches, solo, filters, groups, ambiances.
void draw_lamp_panel(Session& session);
/// The panel of the view: view, ranges, exposure, comparison, quality, places, probe and statistics.
void draw_view_panel(Session& session);
/// The scale of the false colours; nothing in the shaded view.
void draw_legend(const Session& session);
/// The crosshair with the probe's reading, and the pins at their places in the picture.
void draw_probe(const Session& session);
/// The points of the calculation grids with their lux, where nothing hides them, and the corner that is being chosen.
void draw_fields(const Session& session);
/// The sections of the panels on grids and on the selected lamp's light distribution.
void draw_field_section(Session& session);
void draw_photometry_section(Session& session);
/// Rings around the lamps that have no surface, and the name of the selected one.
void draw_lamp_marks(const Session& session);
/// The line between the pictures A and B, which the mouse can drag, and their names.
void draw_split(Session& session);
/// Outlines of bright reflections of lamps in the current view, labelled with surface and lamp; a message while
/// `report` is null.
void draw_reflections(const Session& session, const ReflectionReport* report);
/// The list of all keys.
void draw_keys();
/// The last message to the user, and the progress of a running bake.
void draw_notice(const Session& session, const std::optional<ProgressBoard::State>& baking);

/// Text on a dark plate over the picture, its top left corner at (x, y).
void draw_plate(float x, float y, const std::string& text, uint color = 0xfff0f0f0u);

/// Where a point of the scene lies in a picture of `size`, in ImGui's pixels; nothing when it is behind the eye.
std::optional<vec2> screen_position(const Session& session, vec3 point, vec2 size);

/// The lamp at a pixel: the mesh that glows there, or a point, spot or sun lamp whose mark is near; -1 for none.
int lamp_at(const Session& session, vec2 pixel, vec2 size);

}  // namespace lw
