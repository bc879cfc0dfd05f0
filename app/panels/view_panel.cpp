#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "app/measuring/metering.h"
#include "app/panels/panels.h"
#include "app/session/actions.h"
#include "app/session/saving.h"
#include "base/memory.h"

namespace lw {
namespace {

/// An entry of a combo box: the value it stands for and what the user reads.
struct Entry {
    uint value;
    const char* text;
};

constexpr Entry views[] = {{view_shaded, "shaded"},
                           {view_illuminance, "illuminance, lx"},
                           {view_luminance, "luminance, cd/m2"},
                           {view_difference, "difference, lx"},
                           {view_relative_difference, "difference, %"},
                           {view_photons, "photons"},
                           {view_photon_count, "photons per estimate"},
                           {view_bandwidth, "bandwidth, cm"},
                           {view_error, "estimated error, %"}};
constexpr Entry curves[] = {
    {curve_neutral, "neutral (Khronos)"}, {curve_linear, "linear, clipped"}, {curve_soft, "soft (Reinhard)"}};
constexpr Entry divisors[] = {{0, "automatic"}, {1, "all"}, {2, "half"}, {3, "third"}, {4, "quarter"}};
static_assert(std::size(views) == view_count && std::size(curves) == curve_count);

/// A combo box that sets `value` to that of the chosen entry.
void combo_box(const char* label, std::span<const Entry> entries, uint& value) {
    const auto is_value = [&](const Entry& e) { return e.value == value; };
    const auto now = std::find_if(entries.begin(), entries.end(), is_value);
    if (!ImGui::BeginCombo(label, now == entries.end() ? "" : now->text)) return;
    for (const Entry& e : entries) {
        if (ImGui::Selectable(e.text, e.value == value)) value = e.value;
        if (e.value == value) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
}

void draw_view_choice(Session& s) {
    Viewing& v = s.viewing;
    ImGui::SetNextItemWidth(-1);
    combo_box("##view", views, v.view);
    ImGui::Checkbox("reflections of lamps", &v.reflections);
    if (v.view == view_shaded || v.view == view_photons) return;
    ImGui::Checkbox("auto range", &v.auto_range);
    ImGui::SameLine();
    if (!is_signed_view(v.view)) ImGui::Checkbox("logarithmic", &v.logarithmic);
    if (!v.auto_range) {
        ImGui::SetNextItemWidth(90);
        ImGui::InputFloat("from", &v.low, 0, 0, "%.4g");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(90);
        ImGui::InputFloat("to", &v.high, 0, 0, "%.4g");
        if (!std::isfinite(v.low)) v.low = 0;
        if (!std::isfinite(v.high) || v.high <= v.low) v.high = v.low + 1;
    }
    ImGui::Checkbox("isolux lines", &v.lines);
}

void draw_exposure(Viewing& v) {
    ImGui::Checkbox("automatic", &v.auto_exposure);
    ImGui::SetNextItemWidth(150);
    ImGui::SliderFloat("EV", &v.exposure_ev, -4, 18, "%.2f");
    if (ImGui::IsItemEdited()) v.auto_exposure = false;
    ImGui::SetNextItemWidth(150);
    combo_box("curve", curves, v.curve);
}

void draw_comparison(Session& s) {
    Comparison& c = s.comparison;
    ImGui::Checkbox("A | B", &c.on);
    ImGui::SameLine();
    if (ImGui::Button("keep these lamps as B")) {
        c.lamps = s.lighting.lamps;
        c.name = "kept";
        c.on = true;
    }
    ImGui::SetNextItemWidth(150);
    if (ImGui::BeginCombo("B", c.name.c_str())) {
        const auto choose = [&](const std::string& name, const Ambiance& ambiance) {
            std::vector<std::string> missing;
            c.lamps = with_ambiance(s.world.scene, ambiance, missing);
            c.name = name;
            c.on = true;
        };
        if (ImGui::Selectable("as in the file")) choose("as in the file", {});
        for (const auto& [name, ambiance] : s.lighting.presets.ambiances)
            if (ImGui::Selectable(name.c_str())) choose(name, ambiance);
        ImGui::EndCombo();
    }
    ImGui::SetNextItemWidth(150);
    ImGui::SliderFloat("edge", &c.split, 0, 1, "%.2f");
    if (ImGui::Button("difference lx")) c.on = true, s.viewing.view = view_difference, s.viewing.auto_range = true;
    ImGui::SameLine();
    if (ImGui::Button("difference %"))
        c.on = true, s.viewing.view = view_relative_difference, s.viewing.auto_range = true;
}

void draw_quality(Viewing& v, const FrameStatistics& statistics) {
    const auto text_of = [](const GatherMode& mode) { return std::string(mode.name) + ": " + mode.description; };
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##mode", text_of(gather_mode(v.gather.mode)).c_str())) {
        for (const GatherMode& mode : gather_modes)
            if (ImGui::Selectable(text_of(mode).c_str(), mode.mode == v.gather.mode)) v.gather.mode = mode.mode;
        ImGui::EndCombo();
    }
    int neighbours = int(v.gather.neighbours), rays = int(v.gather.shadow_rays), samples = int(v.max_samples);
    ImGui::SetNextItemWidth(110);
    if (ImGui::SliderInt("photons per estimate", &neighbours, 10, 1000, "%d", ImGuiSliderFlags_Logarithmic))
        v.gather.neighbours = uint(std::clamp(neighbours, 1, 1000));
    ImGui::SetNextItemWidth(110);
    if (ImGui::SliderInt("shadow rays", &rays, 0, 64)) v.gather.shadow_rays = uint(std::clamp(rays, 0, 64));
    ImGui::SetNextItemWidth(110);
    if (ImGui::SliderInt("views while still", &samples, 1, 256)) v.max_samples = uint(std::clamp(samples, 1, 4096));
    ImGui::SetNextItemWidth(110);
    combo_box("pixels in motion", divisors, v.divisor);
    if (statistics.error)
        ImGui::Text("estimated error %.1f %%, 95th percentile %.1f %%", double(statistics.error->x),
                    double(statistics.error->y));
    else
        ImGui::TextDisabled("estimated error: when still, without A | B");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "standard error of the photons' part of the illuminance at the setting above;\n"
            "the cached mode has less: it averages neighbouring estimates");
}

void draw_places(Session& s) {
    const std::vector<Camera>& cameras = s.world.scene.cameras;
    for (size_t i = 0; i < cameras.size() + s.bookmarks.size(); ++i) {
        const std::string& name = i < cameras.size() ? cameras[i].name : s.bookmarks[i - cameras.size()].name;
        if (ImGui::Selectable((std::to_string(i + 1) + "  " + name).c_str())) fly_to(s, i);
    }
    if (ImGui::Button("bookmark (B)")) add_bookmark(s);
    ImGui::SameLine();
    if (ImGui::Button(s.recording ? "end recording (R)" : "record walk (R)")) toggle_recording(s);
    float degrees = s.yfov * 180 / lw_pi;
    ImGui::SetNextItemWidth(110);
    if (ImGui::SliderFloat("field of view", &degrees, 20, 110, "%.0f deg"))
        s.yfov = std::clamp(degrees, 5.0f, 150.0f) * lw_pi / 180;
    ImGui::SetNextItemWidth(110);
    if (ImGui::SliderFloat("eye height", &s.body.eye_height, 0.5f, 2.2f, "%.2f m"))
        s.body.eye_height = std::clamp(s.body.eye_height, 1.5f * s.body.step, 3.0f);
}

void draw_pins(Session& s) {
    ImGui::Checkbox("probe under the crosshair (P)", &s.metering.on);
    for (size_t i = 0; i < s.metering.pins.size(); ++i) {
        const Measurement& m = s.metering.pins[i].value;
        ImGui::Text("%zu  %.4g lx +- %.2g", i + 1, double(m.lux), double(m.half_width_lux));
        ImGui::SameLine();
        ImGui::PushID(int(i));
        const bool gone = ImGui::SmallButton("x");
        ImGui::PopID();
        if (gone) s.metering.pins.erase(s.metering.pins.begin() + std::ptrdiff_t(i--));
    }
    if (!s.metering.pins.empty() && ImGui::Button("save as CSV")) save_pins(s);
}

void draw_statistics(const Session& s) {
    const FrameStatistics& t = s.statistics;
    ImGui::Text("%.1f frames/s, %.1f ms", t.frame_ms > 0 ? 1000 / t.frame_ms : 0, t.frame_ms);
    ImGui::Text("visibility %.2f ms, gather %.2f ms,\nview %.2f ms", t.times.visibility_ms, t.times.gather_ms,
                t.times.view_ms);
    ImGui::Text("%u of %u views summed, pixels 1/%u", t.samples, s.viewing.max_samples, t.times.divisor);
    ImGui::Text("%s photons", std::to_string(t.photons).c_str());
    ImGui::Text("%s on the device,\n%s in the program", bytes_text(t.device_bytes).c_str(),
                bytes_text(resident_memory()).c_str());
}

}  // namespace

void draw_view_panel(Session& s) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(std::max(0.0f, display.x - 300), 10), ImGuiCond_Once);
    ImGui::SetNextWindowSize(ImVec2(290, std::max(120.0f, std::min(620.0f, display.y - 60))), ImGuiCond_Once);
    const auto section = [](const char* name, bool open) {
        ImGui::SetNextItemOpen(open, ImGuiCond_Once);
        return ImGui::CollapsingHeader(name);
    };
    if (ImGui::Begin("View")) {
        draw_view_choice(s);
        if (section("Exposure", true)) draw_exposure(s.viewing);
        if (section("Compare", false)) draw_comparison(s);
        if (section("Probe", true)) draw_pins(s);
        if (section("Calculation grids", false)) draw_field_section(s);
        if (section("Places", false)) draw_places(s);
        s.viewing.wants_error = section("Quality", false);
        if (s.viewing.wants_error) draw_quality(s.viewing, s.statistics);
        if (section("Statistics", true)) draw_statistics(s);
        ImGui::Separator();
        if (ImGui::Button("save (F2)")) s.picture_request = PictureRequest::save;
        ImGui::SameLine();
        if (ImGui::Button("copy (F3)")) s.picture_request = PictureRequest::copy;
        ImGui::SameLine();
        if (ImGui::Button("keys (F1)")) s.keys = !s.keys;
    }
    ImGui::End();
}

}  // namespace lw
