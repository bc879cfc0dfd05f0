// Rays of a pinhole camera, and its choice by name.
#pragma once
#include <string>

#include "scene/scene.h"

namespace lw {

/// The camera of this name (the first one when empty). Throws Error listing the names.
const Camera& find_camera(const Scene& scene, const std::string& name);

/// Unit direction through pixel position (x, y), in pixels from the top left corner; pixel centres at .5.
vec3 camera_direction(const Camera& camera, float x, float y, int width, int height);

/// What a pixel position sees lies on this ray, which begins at the near plane (glTF 2.0, znear).
struct CameraRay {
    vec3 origin, direction;
};
CameraRay camera_ray(const Camera& camera, float x, float y, int width, int height);

}  // namespace lw
