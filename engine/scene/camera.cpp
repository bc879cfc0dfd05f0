#include "scene/camera.h"

#include <cmath>

#include "base/error.h"

namespace lw {
namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

const Camera& find_camera(const Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (name.empty() || camera.name == name) return camera;
        names.push_back(camera.name);
    }
    throw Error(scene.path.filename().string() + ": no camera \"" + name + "\"; there are: " + joined(names));
}

vec3 camera_direction(const Camera& camera, float x, float y, int width, int height) {
    const float half = std::tan(0.5f * camera.yfov);
    const float right = (2 * x / float(width) - 1) * half * float(width) / float(height);
    const float up = (1 - 2 * y / float(height)) * half;
    return normalize(camera.rotation * vec3(right, up, -1));
}

CameraRay camera_ray(const Camera& camera, float x, float y, int width, int height) {
    const vec3 direction = camera_direction(camera, x, y, width, height);
    return {camera.position + direction * (camera.near / -dot(direction, camera.rotation[2])), direction};
}

}  // namespace lw
