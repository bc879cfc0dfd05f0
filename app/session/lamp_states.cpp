#include "app/session/lamp_states.h"
#include "scene/lamp_factors.h"
#include "shaders/color.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/light.h"
#include "shaders/color.h"

namespace lw {
namespace {}  // namespace

std::vector<vec3> factors_of(const LampStates& lamps) {
    const bool any_solo = std::any_of(lamps.begin(), lamps.end(), [](const LampState& l) { return l.solo; });
    std::vector<vec3> factors;
    for (const LampState& lamp : lamps)
        factors.push_back(lamp.on && (lamp.solo || !any_solo) ? lamp.dimmer * lamp.color : vec3(0));
    return factors;
}

Ambiance ambiance_of(const Scene& scene, const LampStates& lamps) {
    Ambiance ambiance;
    for (size_t i = 0; i < lamps.size(); ++i) {
        const LampSetting setting{lamps[i].on ? lamps[i].dimmer : 0.0f, lamps[i].color};
        if (setting != LampSetting{}) ambiance[scene.light_names[i]] = setting;
    }
    return ambiance;
}

LampStates with_ambiance(const Scene& scene, const Ambiance& ambiance, std::vector<std::string>& missing) {
    LampStates lamps(scene.lights.size());
    for (const auto& [name, setting] : ambiance) {
        const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), name);
        if (found == scene.light_names.end()) {
            missing.push_back(name);
            continue;
        }
        LampState& lamp = lamps[size_t(found - scene.light_names.begin())];
        lamp.dimmer = setting.factor;
        lamp.on = setting.factor > 0;
        if (!lamp.on) lamp.dimmer = 1;
        lamp.color =
            factor_of({1, setting.color, setting.kelvin}, scene.lights[size_t(&lamp - lamps.data())].intensity);
    }
    return lamps;
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
