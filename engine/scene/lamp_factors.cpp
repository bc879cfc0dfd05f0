#include "scene/lamp_factors.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/profile.h"

namespace lw {
namespace {

constexpr float max_factor = 1e12f;  // light of the brightest lamps times this stays a float

/// A number, or -1.
float parse_number(const std::string& text) {
    size_t used = 0;
    float number = -1;
    try {
        number = std::stof(text, &used);
    } catch (const std::exception&) {
    }
    return used == text.size() && std::isfinite(number) ? number : -1;
}

/// "FACTOR", "FACTOR@KELVIN" or "FACTOR@KELVINK" of a lamp of this intensity.
vec3 parse_factor(const std::string& text, vec3 intensity) {
    const size_t at = text.find('@');
    const float factor = parse_number(text.substr(0, at));
    if (!(factor >= 0 && factor <= max_factor)) throw Error("the factor must be a number from 0 to 1e12");
    if (at == std::string::npos) return vec3(factor);
    std::string kelvin = text.substr(at + 1);
    if (kelvin.ends_with('K')) kelvin.pop_back();
    const float temperature = parse_number(kelvin);
    if (temperature < 1000 || temperature > 15000) throw Error("the colour temperature must be 1000 to 15000 K");
    return factor * filter_to_temperature(intensity, double(temperature));
}

}  // namespace

size_t find_lamp(const Scene& scene, const std::string& name, const std::string& where) {
    const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), name);
    if (found != scene.light_names.end()) return size_t(found - scene.light_names.begin());
    std::string names;
    for (const std::string& lamp : scene.light_names) names += (names.empty() ? "" : ", ") + lamp;
    throw Error(where + "; there are: " + names);
}

std::vector<vec3> parse_factors(const Scene& scene, const std::vector<std::string>& texts) {
    std::vector<vec3> factors(scene.lights.size(), vec3(1));
    for (const std::string& text : texts) {
        const size_t equals = text.rfind('=');
        if (equals == std::string::npos) throw Error("--power " + text + ": write LIGHT=FACTOR");
        const size_t lamp = find_lamp(scene, text.substr(0, equals), "--power " + text + ": no lamp of this name");
        try {
            factors[lamp] = parse_factor(text.substr(equals + 1), scene.lights[lamp].intensity);
        } catch (const Error& e) {
            throw Error("--power " + text + ": " + e.what());
        }
    }
    return factors;
}

vec3 factor_of(const LampSetting& setting, vec3 intensity) {
    const vec3 factor = setting.factor * setting.color;
    return setting.kelvin > 0 ? factor * filter_to_temperature(intensity, double(setting.kelvin)) : factor;
}

std::vector<vec3> lamp_factors(const Scene& scene, const Ambiance& ambiance) {
    std::vector<vec3> factors(scene.lights.size(), vec3(1));
    for (const auto& [lamp, setting] : ambiance) {
        const size_t i =
            find_lamp(scene, lamp, scene.path.string() + ": no lamp \"" + lamp + "\", which an ambiance names");
        try {
            factors[i] = factor_of(setting, scene.lights[i].intensity);
        } catch (const Error& e) {
            throw Error(scene.path.string() + ": lamp \"" + lamp + "\" of an ambiance: " + e.what());
        }
    }
    return factors;
}

std::vector<vec3> chosen_factors(const Scene& scene, const std::string& name, const std::vector<std::string>& powers) {
    std::vector<vec3> factors = parse_factors(scene, powers);
    if (name.empty()) return factors;
    const std::filesystem::path path = default_ambiances_path(scene.path);
    const LampPresets presets = load_lamp_presets(path);
    const auto found = presets.ambiances.find(name);
    if (found == presets.ambiances.end()) {
        std::string names;
        for (const auto& [other, lamps] : presets.ambiances) names += (names.empty() ? "" : ", ") + other;
        throw Error(path.string() + ": no ambiance \"" + name + "\"; there are: " + (names.empty() ? "none" : names));
    }
    const std::vector<vec3> chosen = lamp_factors(scene, found->second);
    for (size_t i = 0; i < factors.size(); ++i) factors[i] *= chosen[i];
    return factors;
}

}  // namespace lw
