#include "app/walk/places.h"

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

Walker looking(const glm::dvec3& position, double yaw_deg, double pitch_deg, const Scene& scene) {
    Walker w;
    w.eye = vec3(position - scene.origin);
    w.yaw = float(yaw_deg / degrees);
    w.pitch = float(std::clamp(pitch_deg, -89.0, 89.0) / degrees);
    return w;
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

float eased(const ViewTransition& transition) {
    const float t = clamp(transition.passed / std::max(transition.seconds, 1e-3f), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

}  // namespace

Walker walker_at(const ViewTransition& transition) {
    const float t = eased(transition);
    if (t >= 1) return transition.to;
    Walker w = transition.to;
    w.eye = mix(transition.from.eye, transition.to.eye, t);
    w.yaw = transition.from.yaw + std::remainder(transition.to.yaw - transition.from.yaw, 2 * lw_pi) * t;
    w.pitch = mix(transition.from.pitch, transition.to.pitch, t);
    return w;
}

float yfov_at(const ViewTransition& transition) {
    return mix(transition.from_yfov, transition.to_yfov, eased(transition));
}

}  // namespace lw
