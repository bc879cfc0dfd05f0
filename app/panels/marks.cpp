#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/panels/panels.h"
#include "scene/camera.h"

namespace lw {
namespace {

constexpr float pick_reach = 18;  // pixels around the mark of a lamp

ImU32 color_of(vec3 srgb, float alpha = 1) {
    return ImGui::ColorConvertFloat4ToU32(ImVec4(srgb.x, srgb.y, srgb.z, alpha));
}

vec2 display() { return {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y}; }

std::string format(const char* pattern, double value) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

const char* unit_of_view(uint view) {
    switch (view) {
        case view_illuminance:
        case view_difference:
            return "lx";
        case view_luminance:
            return "cd/m2";
        case view_photon_count:
            return "photons";
        case view_bandwidth:
            return "cm";
        default:
            return "%";
    }
}

std::string probe_text(const Session& s, const Measurement& m) {
    const Scene& scene = s.world.scene;
    const uint material = scene.objects[scene.triangle_objects[m.triangle]].material;
    std::string text =
        format("%.4g lx", double(m.lux)) + format("  90 %%: %.4g", std::max(0.0, double(m.lux - m.half_width_lux))) +
        format(" - %.4g lx\n", double(m.lux + m.half_width_lux)) + format("%.4g cd/m2\n", double(m.luminance)) +
        scene.material_names[material] + ", triangle " + std::to_string(m.triangle);
    std::vector<size_t> order;
    for (size_t i = 0; i < m.lamps.size(); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return m.lamps[a].lux > m.lamps[b].lux; });
    for (size_t i = 0; i < std::min<size_t>(5, order.size()); ++i) {
        const LampShare& share = m.lamps[order[i]];
        if (!(share.lux > 0)) break;
        text += "\n" + format("%5.1f %%  ", 100 * double(share.lux / m.lux)) + format("%.4g lx  ", double(share.lux)) +
                scene.light_names[order[i]];
    }
    return text;
}

}  // namespace

void draw_plate(float x, float y, const std::string& text, uint color) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list->AddRectFilled(ImVec2(x - 5, y - 3), ImVec2(x + size.x + 5, y + size.y + 3), IM_COL32(15, 16, 19, 215), 3);
    list->AddText(ImVec2(x, y), color, text.c_str());
}

std::optional<vec2> screen_position(const Session& s, vec3 point, vec2 size) {
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    const vec3 view = glm::transpose(camera.rotation) * (point - camera.position);
    if (view.z > -camera.near) return std::nullopt;
    const float scale = 0.5f * size.y / std::tan(0.5f * camera.yfov);
    return vec2(0.5f * size.x - view.x / view.z * scale, 0.5f * size.y + view.y / view.z * scale);
}

int lamp_at(const Session& s, vec2 pixel, vec2 size) {
    const Scene& scene = s.world.scene;
    int nearest = -1;
    float best = pick_reach;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (!is_at_point(scene.lights[i].type)) continue;
        const std::optional<vec2> at = screen_position(s, scene.lights[i].position, size);
        if (!at || length(*at - pixel) >= best) continue;
        best = length(*at - pixel);
        nearest = int(i);
    }
    if (nearest >= 0) return nearest;
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    const CameraRay ray = camera_ray(camera, pixel.x, pixel.y, int(size.x), int(size.y));
    const std::optional<Hit> hit = seen_from(scene, s.world.caster, ray.origin, ray.direction);
    return hit ? scene.objects[scene.triangle_objects[hit->triangle]].light : -1;
}

void draw_reflections(const Session& s, const ReflectionReport* report) {
    if (!s.viewing.reflections) return;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const vec2 size = display();
    if (!report) {
        draw_plate(0.5f * size.x - 90, 12, "looking for reflections ...");
        return;
    }
    const vec2 pixel(size.x / float(report->width), size.y / float(report->height));
    for (const Reflection& r : report->found) {
        for (const OutlineEdge& e : outline_of(r, report->width))
            list->AddLine(ImVec2(float(e.x0) * pixel.x, float(e.y0) * pixel.y),
                          ImVec2(float(e.x1) * pixel.x, float(e.y1) * pixel.y), IM_COL32(255, 60, 200, 255), 2);
        draw_plate(r.x * pixel.x + 8, r.y * pixel.y + 8, describe(s.world.scene, r), IM_COL32(255, 150, 225, 255));
    }
    const std::string sum = std::to_string(report->found.size()) + " reflections, UGR " + rating_text(report->ugr) +
                            " (lamps alone " + rating_text(report->ugr_lamps) + ")";
    draw_plate(0.5f * size.x - 120, 12, sum);
}

void draw_legend(const Session& s) {
    const Viewing& v = s.viewing;
    if (v.view == view_shaded || v.view == view_photons) return;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const vec2 size = display();
    const float width = std::min(520.0f, 0.6f * size.x), left = 0.5f * (size.x - width), top = size.y - 52;
    const bool logarithmic = v.logarithmic && !is_signed_view(v.view);
    list->AddRectFilled(ImVec2(left - 12, top - 8), ImVec2(left + width + 12, size.y - 8), IM_COL32(15, 16, 19, 225),
                        3);
    constexpr int steps = 104, ticks = 5;
    for (int i = 0; i < steps; ++i) {
        const float t = (float(i) + 0.5f) / steps;
        const vec3 color = is_signed_view(v.view) ? signed_color(t) : false_color(t);
        list->AddRectFilled(ImVec2(left + width * float(i) / steps, top),
                            ImVec2(left + width * float(i + 1) / steps + 1, top + 14), color_of(color));
    }
    for (int i = 0; v.lines && i <= 10; ++i)
        list->AddLine(ImVec2(left + width * float(i) / 10, top), ImVec2(left + width * float(i) / 10, top + 14),
                      IM_COL32(0, 0, 0, 255));
    for (int i = 0; i <= ticks; ++i) {
        const float t = float(i) / ticks;
        std::string text = format("%.4g", double(value_in_range(t, v.low, v.high, logarithmic)));
        if (i == ticks) text += std::string(" ") + unit_of_view(v.view);
        const float middle = ImGui::CalcTextSize(text.c_str()).x / 2, x = left + width * t;
        list->AddText(ImVec2(std::clamp(x - middle, left - 8, left + width + 8 - 2 * middle), top + 18),
                      IM_COL32(235, 235, 235, 255), text.c_str());
    }
}

void draw_probe(const Session& s) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const vec2 size = display(), c = 0.5f * size;
    for (size_t i = 0; i < s.metering.pins.size(); ++i) {
        const Measurement& m = s.metering.pins[i].value;
        const std::optional<vec2> at = screen_position(s, m.position, size);
        if (!at) continue;
        list->AddCircleFilled(ImVec2(at->x, at->y), 4, IM_COL32(255, 190, 60, 255));
        list->AddCircle(ImVec2(at->x, at->y), 5, IM_COL32(0, 0, 0, 255));
        draw_plate(at->x + 10, at->y - 7, std::to_string(i + 1) + ": " + format("%.4g lx", double(m.lux)));
    }
    if (!s.metering.on && !s.fields.chooses) return;
    for (ImU32 color : {IM_COL32(0, 0, 0, 255), IM_COL32(255, 255, 255, 255)}) {
        const float w = color == IM_COL32(255, 255, 255, 255) ? 1.0f : 3.0f;
        list->AddLine(ImVec2(c.x - 9, c.y), ImVec2(c.x + 10, c.y), color, w);
        list->AddLine(ImVec2(c.x, c.y - 9), ImVec2(c.x, c.y + 10), color, w);
    }
    if (!s.metering.on) return;
    draw_plate(c.x + 18, c.y + 14, s.metering.live ? probe_text(s, s.metering.live->value) : "nothing here");
}

void draw_lamp_marks(const Session& s) {
    const Scene& scene = s.world.scene;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const bool selected = s.lighting.selected == int(i);
        if (comes_from_outside(scene.lights[i].type) || (!is_at_point(scene.lights[i].type) && !selected)) continue;
        const std::optional<vec2> at = screen_position(s, scene.lights[i].position, display());
        if (!at) continue;
        const ImU32 color = selected ? IM_COL32(255, 190, 60, 255) : IM_COL32(255, 255, 255, 150);
        list->AddCircle(ImVec2(at->x, at->y), selected ? 9.0f : 6.0f, color, 0, selected ? 2.0f : 1.0f);
        if (selected)
            draw_plate(at->x + 14, at->y - 7,
                       scene.light_names[i] + format("  %.0f %%", 100 * double(s.lighting.lamps[i].dimmer)) +
                           (s.lighting.lamps[i].on ? "" : "  off"));
    }
}

void draw_split(Session& s) {
    if (!s.comparison.on || is_signed_view(s.viewing.view) || is_inspection(s.viewing.view)) return;
    const vec2 size = display();
    const float x = s.comparison.split * size.x;
    ImGui::SetNextWindowPos(ImVec2(x - 8, 0.5f * size.y - 22));
    ImGui::SetNextWindowSize(ImVec2(16, 44));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(4, 4));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    const ImGuiWindowFlags still =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("##edge", nullptr, still)) {
        ImGui::InvisibleButton("##grip", ImVec2(16, 44));
        if (ImGui::IsItemActive()) s.comparison.split = std::clamp(ImGui::GetIO().MousePos.x / size.x, 0.0f, 1.0f);
        if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImDrawList* list = ImGui::GetWindowDrawList();
        for (float dx : {-3.0f, 0.0f, 3.0f})
            list->AddLine(ImVec2(x + dx, 0.5f * size.y - 10), ImVec2(x + dx, 0.5f * size.y + 10),
                          IM_COL32(255, 255, 255, 220));
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    const std::string a = "A: " + (s.lighting.current.empty() ? "lamps as set" : s.lighting.current),
                      b = "B: " + s.comparison.name;
    draw_plate(x - 16 - ImGui::CalcTextSize(a.c_str()).x, size.y - 84, a);
    draw_plate(x + 16, size.y - 84, b);
}

}  // namespace lw
