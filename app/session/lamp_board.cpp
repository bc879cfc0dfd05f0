#include "app/session/lamp_board.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/light.h"
#include "shaders/color.h"

namespace lw {
namespace {}  // namespace

std::vector<vec3> factors_of(const LampBoard& board) {
    const bool any_solo = std::any_of(board.begin(), board.end(), [](const LampState& l) { return l.solo; });
    std::vector<vec3> factors;
    for (const LampState& lamp : board)
        factors.push_back(lamp.on && (lamp.solo || !any_solo) ? lamp.dimmer * lamp.color : vec3(0));
    return factors;
}

Ambiance ambiance_of(const Scene& scene, const LampBoard& board) {
    Ambiance ambiance;
    for (size_t i = 0; i < board.size(); ++i) {
        const LampSetting setting{board[i].on ? board[i].dimmer : 0.0f, board[i].color};
        if (setting != LampSetting{}) ambiance[scene.light_names[i]] = setting;
    }
    return ambiance;
}

LampBoard with_ambiance(const Scene& scene, const Ambiance& ambiance, std::vector<std::string>& missing) {
    LampBoard board(scene.lights.size());
    for (const auto& [name, setting] : ambiance) {
        const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), name);
        if (found == scene.light_names.end()) {
            missing.push_back(name);
            continue;
        }
        LampState& lamp = board[size_t(found - scene.light_names.begin())];
        lamp.dimmer = setting.factor;
        lamp.on = setting.factor > 0;
        if (!lamp.on) lamp.dimmer = 1;
        lamp.color =
            factor_of({1, setting.color, setting.kelvin}, scene.lights[size_t(&lamp - board.data())].intensity);
    }
    return board;
}

std::vector<vec3> mixed(const std::vector<vec3>& from, const std::vector<vec3>& to, float t) {
    std::vector<vec3> factors(to.size());
    for (size_t i = 0; i < to.size(); ++i) factors[i] = mix(from[i], to[i], clamp(t, 0.0f, 1.0f));
    return factors;
}

std::string power_text(const Light& light, float dimmer, float unit_flux) {
    const float intensity = luminance(light.intensity) * dimmer;
    char text[64];
    const float lumens = unit_flux * intensity;
    if (lumens > 0 && !comes_from_outside(light.type))
        std::snprintf(text, sizeof text, "%.4g %s, %.4g lm", double(intensity), unit_of(light.type), double(lumens));
    else
        std::snprintf(text, sizeof text, "%.4g %s", double(intensity), unit_of(light.type));
    return text;
}

}  // namespace lw
