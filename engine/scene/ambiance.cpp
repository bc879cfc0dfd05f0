#include "scene/ambiance.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/json_file.h"

namespace lw {
namespace {

using Json = nlohmann::json;

constexpr float max_factor = 1e6f;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw Error(where + ": " + what); }

float factor_from(const Json& value, const std::string& where) {
    if (!value.is_number()) fail(where, "must be a number");
    const float factor = value.get<float>();
    if (!(factor >= 0 && factor <= max_factor)) fail(where, "must be from 0 to 1000000");
    return factor;
}

LampSetting setting_from(const Json& value, const std::string& where) {
    LampSetting setting;
    if (!value.is_object()) {
        setting.factor = factor_from(value, where);
        return setting;
    }
    for (const auto& [key, part] : value.items()) {
        if (key == "factor") {
            setting.factor = factor_from(part, where + ": factor");
        } else if (key == "color") {
            if (!part.is_array() || part.size() != 3) fail(where, "color must be [red, green, blue]");
            for (int c = 0; c < 3; ++c) setting.color[c] = factor_from(part[size_t(c)], where + ": color");
        } else if (key == "kelvin") {
            if (!part.is_number()) fail(where, "kelvin must be a number");
            setting.kelvin = part.get<float>();
            if (!(setting.kelvin >= 1000 && setting.kelvin <= 15000)) fail(where, "kelvin must be from 1000 to 15000");
        } else {
            fail(where, "unknown entry \"" + key + "\" (there are factor, color and kelvin)");
        }
    }
    return setting;
}

Ambiance ambiance_from(const Json& value, const std::string& where) {
    if (!value.is_object()) fail(where, "must be an object of lamps");
    Ambiance ambiance;
    for (const auto& [lamp, setting] : value.items())
        ambiance[lamp] = setting_from(setting, where + ": lamp \"" + lamp + "\"");
    return ambiance;
}

std::vector<std::string> group_from(const Json& value, const std::string& where) {
    if (!value.is_array()) fail(where, "must be a list of names of lamps");
    std::vector<std::string> lamps;
    for (const Json& lamp : value) {
        if (!lamp.is_string()) fail(where, "must be a list of names of lamps");
        lamps.push_back(lamp.get<std::string>());
    }
    return lamps;
}

/// Calls add(name, value) for the entries of an object that may be missing.
template <class Add>
void each_entry(const Json& file, const char* key, const std::string& where, const Add& add) {
    if (!file.contains(key)) return;
    if (!file[key].is_object()) fail(where, std::string(key) + ": must be an object");
    for (const auto& [name, value] : file[key].items()) add(name, value);
}

}  // namespace

std::filesystem::path default_ambiances_path(const std::filesystem::path& scene) {
    return json_beside(scene, "ambiances");
}

LampPresets load_lamp_presets(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    const Json file = read_json(path);
    const std::string where = path.string();
    if (!file.is_object()) fail(where, "must be an object with ambiances and groups");
    LampPresets presets;
    each_entry(file, "ambiances", where, [&](const std::string& name, const Json& value) {
        presets.ambiances[name] = ambiance_from(value, where + ": ambiance \"" + name + "\"");
    });
    each_entry(file, "groups", where, [&](const std::string& name, const Json& value) {
        presets.groups[name] = group_from(value, where + ": group \"" + name + "\"");
    });
    each_entry(file, "photometry", where, [&](const std::string& name, const Json& value) {
        if (!value.is_string()) fail(where, "photometry: lamp \"" + name + "\": must be the name of a file");
        presets.photometry[name] = value.get<std::string>();
    });
    return presets;
}

void save_lamp_presets(const std::filesystem::path& path, const LampPresets& presets) {
    Json file = {{"ambiances", Json::object()}, {"groups", Json::object()}};
    for (const auto& [name, ambiance] : presets.ambiances) {
        Json& lamps = file["ambiances"][name] = Json::object();
        for (const auto& [lamp, s] : ambiance) {
            lamps[lamp] = s.factor;
            if (s.color == vec3(1) && s.kelvin == 0) continue;
            lamps[lamp] = {{"factor", s.factor}};
            if (s.color != vec3(1)) lamps[lamp]["color"] = {s.color.x, s.color.y, s.color.z};
            if (s.kelvin != 0) lamps[lamp]["kelvin"] = s.kelvin;
        }
    }
    for (const auto& [name, lamps] : presets.groups) file["groups"][name] = lamps;
    if (!presets.photometry.empty()) file["photometry"] = presets.photometry;
    write_json(path, file);
}

}  // namespace lw
