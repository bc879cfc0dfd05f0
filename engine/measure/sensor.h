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

/// The lux per unit solid angle that a radiance of 1 cd/m2 from unit direction `to_light` gives: the cosine to the
/// normal for a planar receiver, the sine of the angle to the axis over pi for a cylindrical one.
float response_to(const Sensor& sensor, vec3 to_light);

/// A direction drawn in proportion to response_to(), from u, v, w in [0, 1). The illuminance is `lux_per_radiance`
/// times the mean radiance over such directions.
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
