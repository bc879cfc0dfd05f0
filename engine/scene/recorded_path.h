// Recorded walks: a JSON file with the place and direction of a camera at some times, and the view at any time between.
// Files hold world positions in metres and angles in degrees.
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

/// Reads a walk. Throws Error naming file and key unless there is at least one key, times rise and numbers are finite.
Path load_path(const std::filesystem::path& path);
void save_path(const std::filesystem::path& file, const Path& path);

/// The view `seconds` after the start, interpolated between the keys (Catmull-Rom). Before the first and after the last
/// key it is that of this key.
Camera camera_on(const Path& path, double seconds, const Scene& scene);

}  // namespace lw
