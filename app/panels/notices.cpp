#include <imgui.h>

#include <chrono>

#include "app/panels/panels.h"

namespace lw {
namespace {

constexpr ImGuiWindowFlags plate = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoFocusOnAppearing;

struct KeyText {
    const char* keys;
    const char* what;
};

constexpr KeyText key_texts[] = {
    {"click", "look around with the mouse; Esc lets it go"},
    {"W A S D, arrows", "walk"},
    {"Shift", "faster"},
    {"F", "fly or walk; Space and Ctrl: up and down"},
    {"1 - 9", "cameras, then bookmarks"},
    {"B", "bookmark this view"},
    {"R", "record the walk, for --play"},
    {"click on a lamp", "select it; wheel: dim, O: on/off, I: solo"},
    {"V, Shift+V", "next view, view before: false colours, photons, errors"},
    {"L, K", "isolux lines; linear or logarithmic"},
    {"X", "A | B"},
    {"[ ]", "darker, brighter; \\: automatic exposure"},
    {"P", "probe; click (or right click) pins it"},
    {"G", "calculation grid: click two opposite corners"},
    {"F2, F3", "picture: save PNG as seen and EXR with the values; copy"},
    {"H, F1, F11", "panels, keys, full screen"},
    {"Ctrl+Q", "quit"},
    {"gamepad", "sticks: walk, look; A B: up, down; X: fly; Y: next view;"},
    {"", "bumper: faster; cross: places, dimmer; Start: panels"},
};

}  // namespace

void draw_keys() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    if (ImGui::Begin("##keys", nullptr, plate) && ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const KeyText& k : key_texts) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.35f, 1), "%s", k.keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(k.what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void draw_notice(const Session& s, const std::optional<ProgressBoard::State>& baking) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    if (std::chrono::steady_clock::now() < s.notice.until) {
        const ImVec2 text = ImGui::CalcTextSize(s.notice.text.c_str()), border = ImGui::GetStyle().WindowPadding;
        ImGui::SetNextWindowPos(ImVec2(size.x / 2, 14), ImGuiCond_Always, ImVec2(0.5f, 0));
        ImGui::SetNextWindowSize(ImVec2(text.x + 2 * border.x, text.y + 2 * border.y));  // fits from its first frame on
        if (ImGui::Begin("##notice", nullptr, plate & ~ImGuiWindowFlags_AlwaysAutoResize))
            ImGui::TextUnformatted(s.notice.text.c_str());
        ImGui::End();
    }
    if (!baking) return;
    ImGui::SetNextWindowPos(ImVec2(size.x / 2, 46), ImGuiCond_Always, ImVec2(0.5f, 0));
    if (ImGui::Begin("##baking", nullptr, plate)) {
        ImGui::Text("baking the light, %s", baking->what.c_str());
        ImGui::ProgressBar(float(baking->fraction), ImVec2(320, 0));
    }
    ImGui::End();
}

}  // namespace lw
