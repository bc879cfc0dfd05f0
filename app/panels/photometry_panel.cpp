#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/panels/panels.h"
#include "app/session/saving.h"
#include "scene/light.h"

namespace lw {
namespace {

constexpr float polar_radius = 74;  // units of a desktop of ordinary resolution

/// Intensity over the angle from straight ahead (down in the picture), in the planes C0-C180 and C90-C270.
void draw_polar_curve(const Scene& scene, const Light& light) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float radius = polar_radius * ImGui::GetFontSize() / 13;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), middle(corner.x + radius + 4, corner.y + radius + 4);
    ImGui::Dummy(ImVec2(2 * radius + 8, 2 * radius + 8));
    for (int ring = 1; ring <= 4; ++ring)
        list->AddCircle(middle, radius * float(ring) / 4, IM_COL32(255, 255, 255, 45), 48);
    for (int ray = 0; ray < 6; ++ray) {
        const float a = float(ray) * lw_pi / 6, x = radius * std::cos(a), y = radius * std::sin(a);
        list->AddLine(ImVec2(middle.x - x, middle.y - y), ImVec2(middle.x + x, middle.y + y),
                      IM_COL32(255, 255, 255, 45));
    }
    for (const auto& [plane, color] :
         {std::pair{90.0f, IM_COL32(120, 170, 255, 255)}, std::pair{0.0f, IM_COL32(255, 190, 60, 255)}}) {
        for (int degree = -180; degree <= 180; degree += 2) {
            const float share =
                share_of_profile(scene, light, float(std::abs(degree)), degree < 0 ? plane + 180 : plane);
            const float angle = float(degree) * lw_pi / 180;
            list->PathLineTo(
                ImVec2(middle.x + radius * share * std::sin(angle), middle.y + radius * share * std::cos(angle)));
        }
        list->PathStroke(color, 0, 1.5f);
    }
}

/// Photometric files in the folder of the scene and the folders in it.
std::vector<std::string> files_beside(const std::filesystem::path& scene) {
    constexpr size_t max_looked_at = 2000;
    const std::filesystem::path folder = scene.parent_path().empty() ? "." : scene.parent_path();
    std::vector<std::string> files;
    std::error_code ignored;
    size_t looked_at = 0;
    for (std::filesystem::recursive_directory_iterator
             i(folder, std::filesystem::directory_options::skip_permission_denied, ignored),
         end;
         !ignored && i != end && looked_at < max_looked_at; i.increment(ignored), ++looked_at) {
        if (i.depth() > 0) i.disable_recursion_pending();
        std::string ending = i->path().extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(tolower(c)); });
        if (ending == ".ies" || ending == ".ldt") files.push_back(i->path().lexically_relative(folder).string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void draw_choice(Session& s, size_t lamp) {
    static std::vector<std::string> files;  // of the list while it is open
    static std::string path;                // the text in the field
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##files", "choose an IES or EULUMDAT file...")) {
        if (ImGui::IsWindowAppearing()) files = files_beside(s.world.scene.path);
        if (files.empty()) ImGui::TextDisabled("no .ies or .ldt beside the scene");
        for (const std::string& file : files)
            if (ImGui::Selectable(file.c_str())) attach_file(s, lamp, file);
        ImGui::EndCombo();
    }
    ImGui::SetNextItemWidth(-60);
    ImGui::InputTextWithHint("##path", "or its path", &path);
    ImGui::SameLine();
    if (ImGui::Button("attach") && !path.empty()) attach_file(s, lamp, path);
}

}  // namespace

void draw_photometry_section(Session& s) {
    if (s.lighting.selected < 0) return;
    const auto lamp = size_t(s.lighting.selected);
    const Light& light = s.world.scene.lights[lamp];
    if (!is_at_point(light.type)) return;
    const std::string& name = s.world.scene.light_names[lamp];
    if (!ImGui::CollapsingHeader(("Light distribution: " + name + "###distribution").c_str())) return;
    const auto known = s.world.luminaires.find(lamp);
    if (known != s.world.luminaires.end()) {
        const Luminaire& luminaire = known->second;
        ImGui::TextWrapped("%s", luminaire.file.empty() ? "part of the scene file" : luminaire.file.c_str());
        if (!luminaire.summary.empty()) ImGui::TextWrapped("%s", luminaire.summary.c_str());
        draw_polar_curve(s.world.scene, light);
        ImGui::TextColored(ImVec4(1, 0.75f, 0.24f, 1), "C0 - C180");
        ImGui::SameLine();
        ImGui::TextColored(ImVec4(0.47f, 0.67f, 1, 1), "C90 - C270");
    } else {
        ImGui::TextDisabled("%s", distribution_text(light.type));
    }
    draw_choice(s, lamp);
    if (s.lighting.presets.photometry.contains(name) && ImGui::Button("take the file off")) attach_file(s, lamp, "");
}

}  // namespace lw
