// Makes sets of sensors: calculation grids of EN 12464-1, evenly spread points of an object, points of a CSV file.
// Texts and files are in world coordinates (metres, Y up); sensors are relative to Scene::origin.
#pragma once
#include <filesystem>

#include "measure/sensor.h"
#include "scene/scene.h"

namespace lw {

/// A calculation grid to be made: a rectangle whose edges are parallel to two axes.
struct GridRequest {
    std::string name;
    glm::dvec3 low{0}, high{0};  // opposite corners; equal in the coordinate of `facing`
    vec3 facing{0, 1, 0};
    double margin = 0;   // m, band along the edges that is left out (EN 12464-1: 0.5 m along walls)
    double spacing = 0;  // m between points; 0: EN 12464-1
    Response response = Response::planar;
    std::string task;
};

/// The largest distance between the points of a grid that EN 12464-1 allows for a field `d` m long: 0.2 x 5^log10(d),
/// at most 10 m.
double grid_spacing(double d);

/// "NAME: X,Y,Z to X,Y,Z [facing=+x|-x|+y|-y|+z|-z] [margin=M] [spacing=M] [kind=planar|cylindrical] [task=PRESET]".
/// Throws Error naming the grid and what is wrong with it.
GridRequest parse_grid(const std::string& text);

/// The sensors of a grid: in the middles of equal cells that are at most request.spacing wide, with sides between 1:2
/// and 2:1 where the field allows it. Without a spacing that of EN 12464-1, where d is the longer side of the field, or
/// the shorter one when the field is longer than 2:1.
SensorSet make_grid(const GridRequest& request, const Scene& scene);

/// "OBJECT[: [facing=+y] [count=N] [task=PRESET]]": N points spread evenly by area over the front faces of an object,
/// only those turned within 45 degrees of `facing` when it is given, 1 mm above it.
/// Throws Error for an unknown object (listing the names) or one without such a face.
SensorSet make_surface(const std::string& text, const Scene& scene);

/// Points of a CSV file: rows name,x,y,z[,nx,ny,nz[,planar|cylindrical]]; a first row starting with "name" is a
/// heading. Without a direction a sensor looks up. Throws Error("FILE: line N: what").
SensorSet read_points(const std::filesystem::path& path, const Scene& scene);

}  // namespace lw
