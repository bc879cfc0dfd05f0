#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "base/error.h"
#include "measure/grid.h"
#include "measure/option_parsing.h"
#include "scene/surface.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double default_count = 64;
constexpr float height_over_surface = 1e-3f;  // m
constexpr float cos_45 = 0.70710678f;

struct SurfaceRequest {
    std::string object, task;
    vec3 facing{0};  // zero: all sides
    uint count = uint(default_count);
};

bool is_object(const Scene& scene, const std::string& name) {
    return std::find(scene.object_names.begin(), scene.object_names.end(), name) != scene.object_names.end();
}

SurfaceRequest parse_surface(const std::string& text, const Scene& scene) {
    SurfaceRequest request{trimmed(text), "", vec3(0), uint(default_count)};
    const size_t colon = text.rfind(':');
    if (is_object(scene, request.object) || colon == std::string::npos) return request;
    request.object = trimmed(text.substr(0, colon));
    const std::string where = "--surface \"" + request.object + "\"";
    std::istringstream stream(text.substr(colon + 1));
    std::vector<std::string> tokens;
    for (std::string token; stream >> token;) tokens.push_back(token);
    auto pairs = parse_pairs(tokens, {"facing", "count", "task"}, where);
    request.task = pairs["task"];
    if (pairs.contains("facing")) request.facing = parse_axis(pairs["facing"], where);
    const double count = pairs.contains("count") ? parse_number(pairs["count"], where + ": count") : default_count;
    if (!(count >= 1 && count <= 1e6)) throw Error(where + ": count is a number of points from 1 to 1000000");
    request.count = uint(count);
    return request;
}

/// The triangles asked for, and the area of each and all before it, m2.
struct Faces {
    std::vector<uint> triangles;
    std::vector<double> area_below;
};

Faces faces_of(const SurfaceRequest& request, const Scene& scene) {
    Faces faces;
    double area = 0;
    for (uint t = 0; t < scene.triangles.size(); ++t) {
        if (scene.object_names[scene.triangle_objects[t]] != request.object) continue;
        const vec3 product = triangle_product(scene, t);
        const float size = length(product);
        if (!(size > 0) || (request.facing != vec3(0) && dot(product, request.facing) < cos_45 * size)) continue;
        faces.triangles.push_back(t);
        faces.area_below.push_back(area += 0.5 * double(size));
    }
    return faces;
}

}  // namespace

SensorSet make_surface(const std::string& text, const Scene& scene) {
    const SurfaceRequest request = parse_surface(text, scene);
    const Faces faces = faces_of(request, scene);
    const std::string where = "--surface \"" + request.object + "\"";
    if (!is_object(scene, request.object)) {
        std::string names;
        for (const std::string& name : std::set<std::string>(scene.object_names.begin(), scene.object_names.end()))
            names += (names.empty() ? "" : ", ") + name;
        throw Error(where + ": no object of this name; there are: " + names);
    }
    if (faces.triangles.empty()) throw Error(where + ": has no face that looks this way");
    SensorSet set{SensorSet::Kind::surface, request.object, request.task, {}, {}, {}};
    const SurfaceReader surfaces(scene);
    for (uint i = 0; i < request.count; ++i) {
        // Stratified along the list of triangles, so that each has its share whatever the number of points.
        const double wanted = (i + 0.5) / request.count * faces.area_below.back();
        const auto chosen = std::upper_bound(faces.area_below.begin(), faces.area_below.end() - 1, wanted);
        const uint triangle = faces.triangles[size_t(chosen - faces.area_below.begin())];
        const Surface s = surfaces.surface_at(triangle, sample_triangle(sobol_owen(i, 0, 1), sobol_owen(i, 1, 1)));
        set.sensors.push_back(
            {s.position + s.geometric_normal * height_over_surface, s.geometric_normal, Response::planar});
    }
    return set;
}

}  // namespace lw
