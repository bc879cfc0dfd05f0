#include "maps/gather_settings.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shaders/scene.h"

namespace lw {

const GatherMode& gather_mode(uint mode) {
    for (const GatherMode& m : gather_modes)
        if (m.mode == mode) return m;
    throw Error("gather: mode " + std::to_string(mode) + " makes no picture");
}

uint gather_mode_named(const std::string& name) {
    for (const GatherMode& m : gather_modes)
        if (m.name == name) return m.mode;
    throw Error("gather: there is no mode " + name);
}

std::vector<std::string> gather_mode_names() {
    std::vector<std::string> names;
    for (const GatherMode& m : gather_modes) names.emplace_back(m.name);
    return names;
}

std::string gather_mode_help() {
    std::string help;
    for (const GatherMode& m : gather_modes)
        help += (help.empty() ? "" : ", ") + std::string(m.name) + " (" + m.description + ")";
    return help;
}

float followed_roughness(const GatherSettings& settings) {
    return settings.shadow_rays > 0 ? std::min(settings.followed_roughness, 1.0f) : std::sqrt(min_alpha);
}

bool has_shadow_rays(const GatherSettings& settings, bool has_visible_lamps) {
    return settings.shadow_rays > 0 || !has_visible_lamps;
}

GatherSettings pipeline_settings(const GatherSettings& settings) {
    return {.mode = settings.mode,
            .neighbours = settings.mode == gather_mode_exact ? settings.neighbours : 0,
            .shadow_rays = settings.shadow_rays > 0 ? 1u : 0u,
            .followed_roughness = settings.followed_roughness};
}

}  // namespace lw
