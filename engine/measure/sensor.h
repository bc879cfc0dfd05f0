// Virtual light meters: a place, a direction and how the receiver weighs light from each side.
// Metres, right-handed, Y up, relative to Scene::origin as all positions of a Scene.
#pragma once
#include <string>
#include <vector>

#include "shaders/scene.h"

namespace lw {

/// How a receiver weighs light (EN 12665): over a plane, or over a thin upright cylinder (the mean of all vertical
/// planes), which is what makes faces visible.
enum class Response { planar, cylindrical };

struct Sensor {
    vec3 position{0};
    vec3 normal{0, 1, 0};  // unit; of a cylindrical receiver its axis
    Response response = Response::planar;
};

/// Lux of a receiver in radiance of 1 cd/m2 per solid angle: the cosine, or sine / pi of the angle to the axis.
float response_to(const Sensor& sensor, vec3 to_light);

/// A direction drawn in proportion to the response from numbers in [0, 1) and what one such direction stands for:
/// lux = `lux_per_radiance` x mean radiance.
struct SensedDirection {
    vec3 direction;
    float lux_per_radiance;  // pi for both kinds
};
SensedDirection sample_direction(const Sensor& sensor, float u, float v, float w);

/// A calculation grid in a rectangle: `columns` x `rows` cells from `corner`, a sensor in the middle of each.
struct GridShape {
    vec3 corner{0};
    vec3 across{0}, along{0};  // m, edges of one cell
    uint columns = 0, rows = 0;
};

/// Sensors reported together: points of a file, a grid (row by row), or the surface of an object.
struct SensorSet {
    enum class Kind { points, grid, surface };
    Kind kind = Kind::points;
    std::string name;
    std::string task;  // name of a preset, or ""
    std::vector<Sensor> sensors;
    std::vector<std::string> sensor_names;  // of points; else empty
    GridShape grid;                         // of a grid
};

}  // namespace lw
