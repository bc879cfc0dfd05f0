// Places to jump to: the cameras of the scene, bookmarks (SCENE.bookmarks.json), and transitions between them.
// Files hold world positions in metres and angles in degrees.
#pragma once
#include "app/walk/walker.h"
#include "scene/recorded_path.h"

namespace lw {

struct Bookmark {
    std::string name;
    glm::dvec3 position{0};  // m, world
    float yaw_deg = 0, pitch_deg = 0;
    float fov_deg = 0;  // vertical; 0: the current one is kept
};

/// The default file of a scene's bookmarks: SCENE.bookmarks.json beside SCENE.glb.
std::filesystem::path default_bookmarks_path(const std::filesystem::path& scene);

/// Reads the bookmarks; none when there is no such file. Throws Error naming file and entry for anything malformed.
std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path);
void save_bookmarks(const std::filesystem::path& path, const std::vector<Bookmark>& bookmarks);

Bookmark bookmark_of(const std::string& name, const Walker& walker, float yfov, const Scene& scene);
/// The bookmark as a camera of the scene.
Camera camera_of(const Bookmark& bookmark, const Scene& scene, float yfov, float near);

/// A smooth transition from one view to another.
struct ViewTransition {
    Walker from, to;
    float from_yfov = 0, to_yfov = 0;  // radians
    float seconds = 1.2f;
    float passed = 0;
};
/// The view after `passed` seconds of the transition. Speed eases in and out, and the view turns the shorter way.
Walker walker_at(const ViewTransition& transition);
float yfov_at(const ViewTransition& transition);

}  // namespace lw
