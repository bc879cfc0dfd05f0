#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/measuring/metering.h"
#include "app/panels/panels.h"

namespace lw {

void draw_field_section(Session& s) {
    Fields& f = s.fields;
    if (ImGui::Button(f.chooses ? "give up (G)" : "by two corners (G)")) toggle_field_choice(s);
    ImGui::SetNextItemWidth(110);
    ImGui::SliderFloat("above what is clicked", &f.height, 0, 2, "%.2f m");
    f.height = std::clamp(f.height, 0.0f, 10.0f);
    ImGui::SetNextItemWidth(-44);
    ImGui::InputTextWithHint("##grid", "NAME: X,Y,Z to X,Y,Z margin=0.5", &f.text);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("as --grid of lumenwalk-measure: metres, Y up; facing=, margin=, spacing=, kind=, task=");
    ImGui::SameLine();
    if (ImGui::Button("add") && !f.text.empty()) add_written_field(s);
    for (size_t i = 0; i < f.fields.size(); ++i) {
        ImGui::PushID(int(f.fields[i].id));
        const bool gone = ImGui::SmallButton("x");
        ImGui::PopID();
        ImGui::SameLine();
        ImGui::Text("%s, %zu points", f.fields[i].request.name.c_str(), f.fields[i].set.sensors.size());
        ImGui::Indent();
        ImGui::TextUnformatted(summary_of(f.fields[i]).c_str());
        ImGui::Unindent();
        if (gone) f.fields.erase(f.fields.begin() + std::ptrdiff_t(i--));
    }
    if (!f.fields.empty() && ImGui::Button("save tables as CSV")) save_fields(s);
}

}  // namespace lw
