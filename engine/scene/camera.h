// Rays of a pinhole camera, and its choice by name.
#pragma once
#include <string>

#include "scene/scene.h"

namespace lw {

/// The camera of this name (the first one when empty). Throws Error listing the names.
const Camera& find_camera(const Scene& scene, const std::string& name);

/// Unit direction from the camera through the position (x, y) in a picture of width x height pixels. Positions count
/// pixels from the top left corner; pixel centres are at .5.
vec3 camera_direction(const Camera& camera, float x, float y, int width, int height);

/// The ray on which everything lies that a position of the picture shows. It begins at the near plane (glTF 2.0,
/// znear).
struct CameraRay {
    vec3 origin, direction;
};
CameraRay camera_ray(const Camera& camera, float x, float y, int width, int height);

}  // namespace lw
