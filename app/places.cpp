#include "app/places.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/json_file.h"

namespace lw {
namespace {

using Json = nlohmann::json;

constexpr double degrees = 180 / 3.14159265358979;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw Error(where + ": " + what); }

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

Walker looking(const glm::dvec3& position, double yaw_deg, double pitch_deg, const Scene& scene) {
    Walker w;
    w.eye = vec3(position - scene.origin);
    w.yaw = float(yaw_deg / degrees);
    w.pitch = float(std::clamp(pitch_deg, -89.0, 89.0) / degrees);
    return w;
}

template <class T>
T catmull_rom(const T& a, const T& b, const T& c, const T& d, double t) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                  (3.0 * b - a - 3.0 * c + d) * (t * t * t));
}

/// The angle nearest to `before` that looks the same way.
double unwrapped(double angle_deg, double before_deg) {
    return before_deg + std::remainder(angle_deg - before_deg, 360.0);
}

}  // namespace

std::filesystem::path default_bookmarks_path(const std::filesystem::path& scene) {
    return json_beside(scene, "bookmarks");
}

std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    const Json file = read_json(path);
    std::vector<Bookmark> bookmarks;
    for (const Json& entry : list_in(file, "bookmarks", path.string())) {
        const std::string where = path.string() + ": bookmark " + std::to_string(bookmarks.size() + 1);
        Bookmark b;
        b.name = entry.contains("name") && entry["name"].is_string() ? entry["name"].get<std::string>()
                                                                     : std::to_string(bookmarks.size() + 1);
        b.position = position_in(entry, where);
        b.yaw_deg = float(number_in(entry, "yaw_deg", where, 0));
        b.pitch_deg = float(number_in(entry, "pitch_deg", where, 0));
        b.fov_deg = float(number_in(entry, "fov_deg", where, 0));
        if (b.fov_deg != 0 && !(b.fov_deg >= 1 && b.fov_deg <= 150)) fail(where, "fov_deg must be from 1 to 150");
        bookmarks.push_back(b);
    }
    return bookmarks;
}

void save_bookmarks(const std::filesystem::path& path, const std::vector<Bookmark>& bookmarks) {
    Json list = Json::array();
    for (const Bookmark& b : bookmarks)
        list.push_back({{"name", b.name},
                        {"position", {b.position.x, b.position.y, b.position.z}},
                        {"yaw_deg", b.yaw_deg},
                        {"pitch_deg", b.pitch_deg},
                        {"fov_deg", b.fov_deg}});
    write_json(path, {{"bookmarks", list}});
}

Bookmark bookmark_of(const std::string& name, const Walker& w, float yfov, const Scene& scene) {
    const auto to_deg = float(degrees);
    return {name, scene.origin + glm::dvec3(w.eye), w.yaw * to_deg, w.pitch * to_deg, yfov * to_deg};
}

Camera camera_of(const Bookmark& b, const Scene& scene, float yfov, float near) {
    Camera camera = camera_of(looking(b.position, double(b.yaw_deg), double(b.pitch_deg), scene),
                              b.fov_deg > 0 ? b.fov_deg / float(degrees) : yfov, near);
    camera.name = b.name;
    return camera;
}

namespace {

float eased(const Flight& flight) {
    const float t = clamp(flight.passed / std::max(flight.seconds, 1e-3f), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

}  // namespace

Walker walker_on(const Flight& flight) {
    const float t = eased(flight);
    if (t >= 1) return flight.to;
    Walker w = flight.to;
    w.eye = mix(flight.from.eye, flight.to.eye, t);
    w.yaw = flight.from.yaw + std::remainder(flight.to.yaw - flight.from.yaw, 2 * lw_pi) * t;
    w.pitch = mix(flight.from.pitch, flight.to.pitch, t);
    return w;
}

float yfov_on(const Flight& flight) { return mix(flight.from_yfov, flight.to_yfov, eased(flight)); }

Path load_path(const std::filesystem::path& path) {
    const Json file = read_json(path);
    Path result;
    const std::string name = path.string();
    for (const Json& entry : list_in(file, "keys", name)) {
        const std::string where = name + ": key " + std::to_string(result.keys.size() + 1);
        PathKey key;
        key.time = number_in(entry, "time", where, 0);
        key.position = position_in(entry, where);
        key.yaw_deg = number_in(entry, "yaw_deg", where, 0);
        key.pitch_deg = number_in(entry, "pitch_deg", where, 0);
        if (!result.keys.empty() && !(key.time > result.keys.back().time)) fail(where, "time must rise");
        result.keys.push_back(key);
    }
    if (result.keys.empty()) fail(name, "has no keys");
    result.frames_per_second = number_in(file, "fps", name, 30);
    result.fov_deg = number_in(file, "fov_deg", name, 0);
    if (!(result.frames_per_second >= 0.01 && result.frames_per_second <= 1000))
        fail(name, "fps must be from 0.01 to 1000");
    if (result.fov_deg != 0 && !(result.fov_deg >= 1 && result.fov_deg <= 150))
        fail(name, "fov_deg must be from 1 to 150");
    if (result.seconds() * result.frames_per_second > 1e6) fail(name, "has more than 1000000 frames");
    return result;
}

void save_path(const std::filesystem::path& file, const Path& path) {
    Json keys = Json::array();
    for (const PathKey& k : path.keys)
        keys.push_back({{"time", k.time},
                        {"position", {k.position.x, k.position.y, k.position.z}},
                        {"yaw_deg", k.yaw_deg},
                        {"pitch_deg", k.pitch_deg}});
    write_json(file, {{"fps", path.frames_per_second}, {"fov_deg", path.fov_deg}, {"keys", keys}});
}

Camera camera_on(const Path& path, double seconds, const Scene& scene) {
    const std::vector<PathKey>& keys = path.keys;
    const double time = std::clamp(keys.front().time + seconds, keys.front().time, keys.back().time);
    size_t i = 0;
    while (i + 2 < keys.size() && keys[i + 1].time <= time) ++i;
    const auto at = [&](size_t k) -> const PathKey& { return keys[std::min(k, keys.size() - 1)]; };
    const PathKey &a = at(i ? i - 1 : 0), &b = at(i), &c = at(i + 1), &d = at(i + 2);
    const double t = c.time > b.time ? (time - b.time) / (c.time - b.time) : 0;
    const double yaw_b = b.yaw_deg, yaw_a = unwrapped(a.yaw_deg, yaw_b), yaw_c = unwrapped(c.yaw_deg, yaw_b);
    const double yaw = catmull_rom(yaw_a, yaw_b, yaw_c, unwrapped(d.yaw_deg, yaw_c), t);
    const double pitch = catmull_rom(a.pitch_deg, b.pitch_deg, c.pitch_deg, d.pitch_deg, t);
    const glm::dvec3 position = catmull_rom(a.position, b.position, c.position, d.position, t);
    const Camera& first = scene.cameras[0];
    return camera_of(looking(position, yaw, pitch, scene),
                     path.fov_deg > 0 ? float(path.fov_deg / degrees) : first.yfov, first.near);
}

}  // namespace lw
