#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "app/panels/panels.h"
#include "app/session/actions.h"
#include "app/session/saving.h"
#include "scene/light.h"

namespace lw {
namespace {

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool matches(const std::string& name, const std::string& search) {
    return lower(name).find(lower(search)) != std::string::npos;
}

bool draw_dimmer(const char* label, float& dimmer) {
    float percent = 100 * dimmer;
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::SliderFloat(label, &percent, 0, 200, "%.0f %%")) return false;
    dimmer = std::clamp(percent / 100, 0.0f, 1e4f);
    return true;
}

std::string power_of(const Session& s, size_t i) {
    const auto luminaire = s.world.luminaires.find(i);
    const float flux = luminaire == s.world.luminaires.end() ? unit_flux(s.world.scene, s.world.scene.lights[i])
                                                             : luminaire->second.unit_flux;
    const LampState& lamp = s.lighting.lamps[i];
    return power_text(s.world.scene.lights[i], lamp.on ? lamp.dimmer : 0, flux);
}

/// The menu of the right mouse button on a lamp: the groups that it belongs to.
void draw_group_menu(Session& s, const std::string& lamp) {
    if (!ImGui::BeginPopupContextItem("##groups")) return;
    auto& groups = s.lighting.presets.groups;
    if (groups.empty()) ImGui::TextDisabled("no groups yet: write a name above, then \"as group\"");
    for (auto& [name, lamps] : groups) {
        const auto found = std::find(lamps.begin(), lamps.end(), lamp);
        if (!ImGui::MenuItem(("in group " + name).c_str(), nullptr, found != lamps.end())) continue;
        if (found != lamps.end())
            lamps.erase(found);
        else
            lamps.push_back(lamp);
        save_presets(s, "group \"" + name + "\"");
    }
    ImGui::EndPopup();
}

void draw_lamp(Session& s, size_t i) {
    Lighting& l = s.lighting;
    LampState& lamp = l.lamps[i];
    ImGui::PushID(int(i));
    const bool selected = l.selected == int(i);
    ImGui::Checkbox("##on", &lamp.on);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("on / off");
    ImGui::SameLine();
    if (ImGui::Selectable(s.world.scene.light_names[i].c_str(), selected, 0,
                          ImVec2(ImGui::GetContentRegionAvail().x - 62, 0)))
        l.selected = selected ? -1 : int(i);
    draw_group_menu(s, s.world.scene.light_names[i]);
    if (selected && !ImGui::IsItemVisible() && s.lighting.selected != s.lighting.scrolled_to) ImGui::SetScrollHereY();
    if (selected) s.lighting.scrolled_to = s.lighting.selected;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 54);
    ImGui::ColorEdit3("##filter", &lamp.color.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("filter: what the lamp's light is multiplied by");
    ImGui::SameLine();
    if (lamp.solo) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.75f, 0.52f, 0.1f, 1));
    const bool was_solo = lamp.solo;
    if (ImGui::SmallButton("S")) lamp.solo = !lamp.solo;
    if (was_solo) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("solo: only such lamps are lit");
    draw_dimmer("##dimmer", lamp.dimmer);
    ImGui::TextDisabled("  %s", power_of(s, i).c_str());
    ImGui::PopID();
}

/// The lamps of a group under a heading with a dimmer and a switch for all of them. `by_hand`: the user made the group.
void draw_group(Session& s, const std::string& name, const std::vector<size_t>& lamps, bool by_hand) {
    Lighting& l = s.lighting;
    ImGui::PushID(name.c_str());
    ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (ImGui::CollapsingHeader((name + "##group").c_str())) {
        bool all_on = std::all_of(lamps.begin(), lamps.end(), [&](size_t i) { return l.lamps[i].on; });
        if (ImGui::Checkbox("##all", &all_on))
            for (size_t i : lamps) l.lamps[i].on = all_on;
        ImGui::SameLine();
        float mean = 0;
        for (size_t i : lamps) mean += l.lamps[i].dimmer / float(lamps.size());
        if (draw_dimmer("##group dimmer", mean))
            for (size_t i : lamps) l.lamps[i].dimmer = mean;
        if (by_hand && ImGui::SmallButton("dissolve group")) {
            l.presets.groups.erase(name);
            save_presets(s, "without group \"" + name + "\": groups");
        }
        for (size_t i : lamps)
            if (matches(s.world.scene.light_names[i], l.search)) draw_lamp(s, i);
    }
    ImGui::PopID();
}

void draw_groups(Session& s) {
    const Scene& scene = s.world.scene;
    std::map<std::string, std::vector<size_t>> by_parent;
    std::vector<size_t> alone;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (!matches(scene.light_names[i], s.lighting.search)) continue;
        if (scene.light_groups[i].empty())
            alone.push_back(i);
        else
            by_parent[scene.light_groups[i]].push_back(i);
    }
    const auto groups = s.lighting.presets.groups;  // a copy: dissolving changes the presets
    for (const auto& [name, names] : groups) {
        std::vector<size_t> lamps;
        for (size_t i = 0; i < scene.lights.size(); ++i)
            if (std::count(names.begin(), names.end(), scene.light_names[i])) lamps.push_back(i);
        if (!lamps.empty()) draw_group(s, name, lamps, true);
    }
    for (const auto& [name, lamps] : by_parent) draw_group(s, name, lamps, false);
    for (size_t i : alone) draw_lamp(s, i);
}

void choose_ambiance(Session& s, const std::string& name, const Ambiance& ambiance) {
    std::vector<std::string> missing;
    fade_to(s.lighting, with_ambiance(s.world.scene, ambiance, missing));
    s.lighting.current = name;
    for (const std::string& lamp : missing)
        tell(s, "ambiance \"" + name + "\": the scene has no lamp \"" + lamp + "\"");
}

void draw_ambiances(Session& s) {
    Lighting& l = s.lighting;
    static std::string new_name;  // the text in the input field
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##ambiance", l.current.empty() ? "ambiance..." : l.current.c_str())) {
        if (ImGui::Selectable("as in the file")) choose_ambiance(s, "as in the file", {});
        for (const auto& [name, ambiance] : l.presets.ambiances)
            if (ImGui::Selectable(name.c_str())) choose_ambiance(s, name, ambiance);
        ImGui::EndCombo();
    }
    ImGui::SetNextItemWidth(100);
    ImGui::SliderFloat("crossfade", &l.fade_seconds, 0, 10, "%.1f s");
    ImGui::SetNextItemWidth(140);
    ImGui::InputTextWithHint("##name", "name", &new_name);
    ImGui::SameLine();
    if (ImGui::Button("save") && !new_name.empty()) {
        l.presets.ambiances[new_name] = ambiance_of(s.world.scene, l.lamps);
        l.current = new_name;
        save_presets(s, "ambiance \"" + new_name + "\"");
    }
    ImGui::SameLine();
    if (ImGui::Button("as group") && !new_name.empty()) {
        std::vector<std::string>& group = l.presets.groups[new_name];
        group.clear();
        for (size_t i = 0; i < l.lamps.size(); ++i)
            if (l.lamps[i].solo || (l.search.size() && matches(s.world.scene.light_names[i], l.search)))
                group.push_back(s.world.scene.light_names[i]);
        save_presets(s, "group \"" + new_name + "\"");
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("the lamps that the search finds, and those in solo, as a group");
}

}  // namespace

void draw_lamp_panel(Session& s) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_Once);
    ImGui::SetNextWindowSize(ImVec2(290, std::max(120.0f, std::min(620.0f, display.y - 60))), ImGuiCond_Once);
    if (ImGui::Begin("Lamps")) {
        draw_ambiances(s);
        ImGui::Separator();
        ImGui::SetNextItemWidth(-60);
        ImGui::InputTextWithHint("##search", "search", &s.lighting.search);
        ImGui::SameLine();
        if (ImGui::Button("reset")) fade_to(s.lighting, LampStates(s.lighting.lamps.size()));
        draw_photometry_section(s);
        if (ImGui::BeginChild("lamps")) draw_groups(s);
        ImGui::EndChild();
    }
    ImGui::End();
}

}  // namespace lw
