// What is drawn over the picture with Dear ImGui: panels read and write the session, nothing else.
#pragma once
#include "app/baking.h"
#include "app/measuring/reflection_search.h"
#include "app/session/session.h"

namespace lw {

/// Lamps: search, dimmers, switches, solo, filters, groups, ambiances.
void draw_lamp_panel(Session& session);
/// View, ranges, exposure, comparison, quality, places, probe and statistics. Its buttons write requests into the
/// session.
void draw_view_panel(Session& session);
/// The scale of the false colours; nothing in the shaded view.
void draw_legend(const Session& session);
/// Crosshair with what the probe reads, and the pins where they are in the picture.
void draw_probe(const Session& session);
/// The points of the calculation grids with their lux, where nothing hides them, and the corner that is being chosen.
void draw_fields(const Session& session);
/// The sections of the panels on grids and on the selected lamp's light distribution.
void draw_field_section(Session& session);
void draw_photometry_section(Session& session);
/// Rings around the lamps that have no surface, and the name of the selected one.
void draw_lamp_marks(const Session& session);
/// The edge between A and B, which the mouse can drag, and their names.
void draw_split(Session& session);
/// Outlines of bright reflections of lamps in the present view, with what mirrors which; a line while they are looked
/// for.
void draw_reflections(const Session& session, const ReflectionReport* report);
/// All keys.
void draw_keys();
/// The line told last, and the bake that runs.
void draw_notice(const Session& session, const std::optional<ProgressBoard::State>& baking);

/// Text on a dark plate over the picture, its top left corner at (x, y).
void draw_plate(float x, float y, const std::string& text, uint color = 0xfff0f0f0u);

/// Where a point lies in the picture, in pixels of ImGui; none behind the eye.
std::optional<vec2> screen_position(const Session& session, vec3 point, vec2 size);

/// The lamp at a pixel: the mesh that glows there, or a point, spot or sun lamp whose mark is near; -1 for none.
int lamp_at(const Session& session, vec2 pixel, vec2 size);

}  // namespace lw
