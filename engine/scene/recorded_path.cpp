#include "scene/recorded_path.h"

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

template <class T>
T catmull_rom(const T& a, const T& b, const T& c, const T& d, double t) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                  (3.0 * b - a - 3.0 * c + d) * (t * t * t));
}

/// `angle_deg` plus a multiple of 360, so that it is nearest to `before_deg`.
double unwrapped(double angle_deg, double before_deg) {
    return before_deg + std::remainder(angle_deg - before_deg, 360.0);
}

Camera looking(const Path& path, const Scene& scene, const glm::dvec3& position, double yaw_deg, double pitch_deg) {
    const double yaw = yaw_deg / degrees, pitch = std::clamp(pitch_deg, -89.0, 89.0) / degrees;
    const glm::dvec3 right(std::cos(yaw), 0, -std::sin(yaw)), level(-std::sin(yaw), 0, -std::cos(yaw));
    const glm::dvec3 ahead = level * std::cos(pitch) + glm::dvec3(0, std::sin(pitch), 0);
    Camera camera;
    camera.name = "walker";
    camera.position = vec3(position - scene.origin);
    camera.rotation = mat3(vec3(right), vec3(cross(right, ahead)), vec3(-ahead));
    camera.yfov = path.fov_deg > 0 ? float(path.fov_deg / degrees) : scene.cameras[0].yfov;
    camera.near = scene.cameras[0].near;
    return camera;
}

}  // namespace

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
    return looking(path, scene, position, yaw, pitch);
}

}  // namespace lw
