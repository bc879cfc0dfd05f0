// Places to jump to and paths to replay: the cameras of the scene, bookmarks (SCENE.bookmarks.json) and recorded walks.
// Files hold world positions in metres and angles in degrees.
#pragma once
#include "app/walker.h"

namespace lw {

struct Bookmark {
    std::string name;
    glm::dvec3 position{0};  // m, world
    float yaw_deg = 0, pitch_deg = 0;
    float fov_deg = 0;  // vertical; 0: as it is
};

/// SCENE.glb -> SCENE.bookmarks.json.
std::filesystem::path default_bookmarks_path(const std::filesystem::path& scene);

/// Empty when there is no such file. Throws Error naming file and entry for anything malformed.
std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path);
void save_bookmarks(const std::filesystem::path& path, const std::vector<Bookmark>& bookmarks);

Bookmark bookmark_of(const std::string& name, const Walker& walker, float yfov, const Scene& scene);
/// The bookmark as a camera of the scene.
Camera camera_of(const Bookmark& bookmark, const Scene& scene, float yfov, float near);

/// A smooth way from one view to another.
struct Flight {
    Walker from, to;
    float from_yfov = 0, to_yfov = 0;  // radians
    float seconds = 1.2f;
    float passed = 0;
};
/// Where the flight is after its `passed` seconds: eased, turning the shorter way.
Walker walker_on(const Flight& flight);
float yfov_on(const Flight& flight);

/// One moment of a recorded walk.
struct PathKey {
    double time = 0;  // s
    glm::dvec3 position{0};
    double yaw_deg = 0, pitch_deg = 0;
};

struct Path {
    double frames_per_second = 30;
    double fov_deg = 0;  // vertical; 0: that of the first camera
    std::vector<PathKey> keys;

    double seconds() const { return keys.back().time - keys.front().time; }
};

/// Throws Error naming file and key for anything malformed: at least one key, times that rise, finite numbers.
Path load_path(const std::filesystem::path& path);
void save_path(const std::filesystem::path& file, const Path& path);

/// The view `seconds` after the start, between the keys (Catmull-Rom), beyond the ends the ends.
Camera camera_on(const Path& path, double seconds, const Scene& scene);

}  // namespace lw
