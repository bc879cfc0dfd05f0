// Recorded walks: moments of a camera in a JSON file, and the view at any time between them. Files hold world positions
// in metres and angles in degrees.
#pragma once
#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace lw {

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
