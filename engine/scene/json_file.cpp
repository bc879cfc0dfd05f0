#include "scene/json_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/input_file.h"
#include "base/replaced_file.h"

namespace lw {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw Error(where + ": " + what); }

}  // namespace

nlohmann::json read_json(const std::filesystem::path& path) {
    constexpr uintmax_t max_bytes = uintmax_t(64) << 20;
    std::error_code failure;
    std::ifstream stream = open_input(path);
    if (!stream) throw Error(path.string() + ": cannot be opened");
    if (std::filesystem::file_size(path, failure) > max_bytes) throw Error(path.string() + ": larger than 64 MiB");
    std::vector<std::set<std::string>> keys;  // of the objects that are open
    const auto check_keys = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
            fail(path.string(), "\"" + value.get<std::string>() + "\" is written twice in one object");
        return true;
    };
    try {
        return Json::parse(stream, check_keys);
    } catch (const nlohmann::json::exception& wrong) {
        throw Error(path.string() + ": is not JSON: " + wrong.what());
    }
}

void write_json(const std::filesystem::path& path, const nlohmann::json& value) {
    ReplacedFile file(path);
    file.stream() << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    file.commit();
}

double number_in(const Json& entry, const char* key, const std::string& where, double otherwise) {
    if (!entry.contains(key)) return otherwise;
    if (!entry[key].is_number()) fail(where, std::string(key) + " must be a number");
    const double value = entry[key].get<double>();
    if (!std::isfinite(value) || std::abs(value) > 1e9) fail(where, std::string(key) + " is out of range");
    return value;
}

glm::dvec3 position_in(const Json& entry, const std::string& where) {
    const auto is_number = [](const Json& v) { return v.is_number(); };
    if (!entry.contains("position") || !entry["position"].is_array() || entry["position"].size() != 3 ||
        !std::all_of(entry["position"].begin(), entry["position"].end(), is_number))
        fail(where, "position must be [x, y, z] in metres");
    const Json& p = entry["position"];
    const glm::dvec3 position(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    if (!(length(position) < 1e9)) fail(where, "position is out of range");
    return position;
}

const Json& list_in(const Json& file, const char* key, const std::string& where) {
    if (!file.is_object() || !file.contains(key) || !file[key].is_array())
        fail(where, std::string("must have a list \"") + key + "\"");
    for (const Json& entry : file[key])
        if (!entry.is_object()) fail(where, std::string(key) + ": every entry must be an object");
    return file[key];
}

std::filesystem::path json_beside(const std::filesystem::path& scene, const std::string& what) {
    std::filesystem::path path = scene;
    return path.replace_extension("." + what + ".json");
}

}  // namespace lw
