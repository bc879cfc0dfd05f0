#include "measure/grid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "measure/option_parsing.h"

namespace lw {
namespace {

constexpr double max_sensors = 1e6;

std::vector<std::string> tokens_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> tokens;
    for (std::string token; stream >> token;) tokens.push_back(token);
    return tokens;
}

int axis_of(vec3 facing) { return facing.x != 0 ? 0 : facing.y != 0 ? 1 : 2; }

/// The number of cells along a side of the field (m), so that none is wider than the spacing. EN 12464-1 rounds to the
/// nearest number, which may make them wider.
uint cells_of(double side, double spacing) { return uint(std::max(1.0, std::ceil(side / spacing - 1e-9))); }

}  // namespace

double grid_spacing(double d) { return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d))); }

GridRequest parse_grid(const std::string& text) {
    const size_t colon = text.find(':');
    const std::string name = trimmed(text.substr(0, colon)), where = "--grid \"" + name + "\"";
    if (colon == std::string::npos || name.empty()) throw Error("--grid \"" + text + "\": write NAME: X,Y,Z to X,Y,Z");
    const std::vector<std::string> tokens = tokens_of(text.substr(colon + 1));
    if (tokens.size() < 3 || tokens[1] != "to") throw Error(where + ": write NAME: X,Y,Z to X,Y,Z");
    const glm::dvec3 a = parse_point(tokens[0], where), b = parse_point(tokens[2], where);
    auto pairs =
        parse_pairs({tokens.begin() + 3, tokens.end()}, {"facing", "margin", "spacing", "kind", "task"}, where);
    GridRequest grid{name, glm::min(a, b), glm::max(a, b), {0, 1, 0}, 0, 0, Response::planar, pairs["task"]};
    if (pairs.contains("facing")) grid.facing = parse_axis(pairs["facing"], where);
    if (pairs.contains("margin")) grid.margin = parse_number(pairs["margin"], where + ": margin");
    if (pairs.contains("spacing")) grid.spacing = parse_number(pairs["spacing"], where + ": spacing");
    if (pairs.contains("kind")) grid.response = parse_response(pairs["kind"], where);
    if (grid.margin < 0 || grid.spacing < 0 || (pairs.contains("spacing") && grid.spacing == 0))
        throw Error(where + ": margin and spacing are lengths in metres");
    for (int axis = 0; axis < 3; ++axis) {
        const double side = grid.high[axis] - grid.low[axis];
        if (axis == axis_of(grid.facing) ? side != 0 : side <= 2 * grid.margin)
            throw Error(where + ": the corners do not span a rectangle across its direction" +
                        (grid.margin > 0 ? " wider than its margins" : "") + "; for a wall give facing=");
    }
    return grid;
}

SensorSet make_grid(const GridRequest& request, const Scene& scene) {
    const int normal_axis = axis_of(request.facing);
    // Columns follow x, but z on a wall that faces x. Rows follow z, but go upwards on a wall.
    const int across = normal_axis == 0 ? 2 : 0, along = normal_axis == 1 ? 2 : 1;
    const double width = request.high[across] - request.low[across] - 2 * request.margin;
    const double height = request.high[along] - request.low[along] - 2 * request.margin;
    const double longer = std::max(width, height), shorter = std::min(width, height);
    const double spacing =
        request.spacing > 0 ? request.spacing : grid_spacing(longer >= 2 * shorter ? shorter : longer);
    if (width / spacing * height / spacing > max_sensors)
        throw Error("--grid \"" + request.name + "\": more than a million points; give a larger spacing");
    GridShape shape{};
    shape.columns = cells_of(width, spacing), shape.rows = cells_of(height, spacing);
    shape.corner = vec3(request.low - scene.origin);
    shape.corner[across] += float(request.margin), shape.corner[along] += float(request.margin);
    shape.across[across] = float(width / shape.columns);
    shape.along[along] = float(height / shape.rows);
    SensorSet set{SensorSet::Kind::grid, request.name, request.task, {}, {}, shape};
    for (uint row = 0; row < shape.rows; ++row)
        for (uint column = 0; column < shape.columns; ++column)
            set.sensors.push_back(
                {shape.corner + shape.across * (float(column) + 0.5f) + shape.along * (float(row) + 0.5f),
                 request.facing, request.response});
    return set;
}

SensorSet read_points(const std::filesystem::path& path, const Scene& scene) {
    const std::vector<std::string> lines = read_lines(path);
    SensorSet set{SensorSet::Kind::points, path.stem().string(), "", {}, {}, {}};
    for (size_t i = 0; i < lines.size(); ++i) {
        if (trimmed(lines[i]).empty()) continue;
        const std::string where = path.string() + ": line " + std::to_string(i + 1);
        const std::vector<std::string> cells = split(lines[i], ',');
        if (i == 0 && cells[0] == "name") continue;
        if (cells.size() != 4 && cells.size() != 7 && cells.size() != 8)
            throw Error(where + ": write name,x,y,z or name,x,y,z,nx,ny,nz or with planar or cylindrical after it");
        Sensor sensor;
        sensor.position = vec3(parse_point(cells[1] + "," + cells[2] + "," + cells[3], where) - scene.origin);
        if (cells.size() >= 7) {
            const glm::dvec3 normal = parse_point(cells[4] + "," + cells[5] + "," + cells[6], where);
            if (!(glm::length(normal) > 1e-6)) throw Error(where + ": the direction has no length");
            sensor.normal = vec3(glm::normalize(normal));
        }
        if (cells.size() == 8) sensor.response = parse_response(cells[7], where);
        set.sensors.push_back(sensor);
        set.sensor_names.push_back(cells[0]);
    }
    if (set.sensors.empty()) throw Error(path.string() + ": has no points");
    return set;
}

}  // namespace lw
