#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/panels/panels.h"
#include "shaders/view.h"

namespace lw {
namespace {

constexpr float min_pixels = 26;        // least width of a cell in which its value is written
constexpr float hidden_within = 0.01f;  // m; a surface this close to a sensor does not hide it

vec2 display() { return {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y}; }

ImVec2 of(vec2 v) { return {v.x, v.y}; }

bool is_seen(const Session& s, vec3 point) {
    const vec3 path = point - s.walker.eye;
    const float distance = length(path);
    return distance > 0 &&
           !s.world.caster.nearest(s.walker.eye, path / distance, distance * (1 - 1e-4f) - hidden_within);
}

ImU32 color_in_range(const Session& s, double lux, float high) {
    const bool shown = s.viewing.view == view_illuminance;  // as the picture around it
    const float t = shown ? place_in_range(float(lux), s.viewing.low, s.viewing.high, s.viewing.logarithmic)
                          : float(lux) / std::max(high, 1e-6f);
    const vec3 c = false_color(t);
    return ImGui::ColorConvertFloat4ToU32(ImVec4(c.x, c.y, c.z, 0.55f));
}

/// One cell of a grid: filled with its colour, its lux when there is room.
void draw_cell(const Session& s, const Field& field, size_t i) {
    const GridShape& grid = field.set.grid;
    const vec3 at = field.set.sensors[i].position;
    if (!is_seen(s, at)) return;
    std::array<vec2, 4> corners;
    constexpr float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (size_t c = 0; c < 4; ++c) {
        const auto p =
            screen_position(s, at + 0.5f * (signs[c][0] * grid.across + signs[c][1] * grid.along), display());
        if (!p) return;
        corners[c] = *p;
    }
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const bool known = i < field.values.size() && !field.readings[i].blocked;
    const ImU32 fill = known ? color_in_range(s, field.values[i].lux, float(field.statistics.maximum.value))
                             : IM_COL32(128, 128, 128, 90);
    list->AddQuadFilled(of(corners[0]), of(corners[1]), of(corners[2]), of(corners[3]), fill);
    list->AddQuad(of(corners[0]), of(corners[1]), of(corners[2]), of(corners[3]), IM_COL32(0, 0, 0, 150));
    const float width = std::max(std::abs(corners[1].x - corners[0].x), std::abs(corners[2].x - corners[1].x));
    if (!known || width < min_pixels * ImGui::GetFontSize() / 13) return;
    char text[24];
    std::snprintf(text, sizeof text, field.values[i].lux < 10 ? "%.1f" : "%.0f", field.values[i].lux);
    const ImVec2 size = ImGui::CalcTextSize(text);
    const vec2 middle = 0.25f * (corners[0] + corners[1] + corners[2] + corners[3]);
    const ImVec2 place(middle.x - 0.5f * size.x, middle.y - 0.5f * size.y);
    list->AddText(ImVec2(place.x + 1, place.y + 1), IM_COL32(0, 0, 0, 220), text);
    list->AddText(place, field.values[i].doubt.empty() ? IM_COL32_WHITE : IM_COL32(255, 150, 140, 255), text);
}

/// Writes the statistics under the corner that is lowest in the picture, where they hide no point.
void draw_sums(const Session& s, const Field& field) {
    const GridShape& grid = field.set.grid;
    const vec3 across = float(grid.columns) * grid.across, along = float(grid.rows) * grid.along;
    std::optional<vec2> lowest;
    for (const vec3& corner : {grid.corner, grid.corner + across, grid.corner + along, grid.corner + across + along}) {
        const auto at = screen_position(s, corner, display());
        if (at && is_seen(s, corner) && (!lowest || at->y > lowest->y)) lowest = at;
    }
    if (lowest) draw_plate(lowest->x + 8, lowest->y + 8, field.request.name + "\n" + summary_of(field));
}

}  // namespace

void draw_fields(const Session& s) {
    for (const Field& field : s.fields.fields) {
        for (size_t i = 0; i < field.set.sensors.size(); ++i) draw_cell(s, field, i);
        draw_sums(s, field);
    }
    if (!s.fields.corner) return;
    if (const auto at = screen_position(s, *s.fields.corner, display()))
        ImGui::GetBackgroundDrawList()->AddCircleFilled(of(*at), 5, IM_COL32(255, 190, 60, 255));
}

}  // namespace lw
