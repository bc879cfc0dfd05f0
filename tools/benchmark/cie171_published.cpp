// The rooms and points of CIE 171:2006. Each expected value is our closed form; `published` is what public copies of
// the standard print (5.7: as corrected later), in lx or, for 5.6 and 5.7, in percent of rho E on the reflecting
// surface.
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "cie171_laboratory.h"
#include "lab_scene.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Points of a case that look the same way.
struct Receivers {
    CieCase name;
    std::vector<vec3> points;
    vec3 normal;
    std::vector<double> published;
};

/// Illuminance of a point, lx, by closed form.
using Formula = std::function<double(glm::dvec3 point, glm::dvec3 normal)>;

void compare(Laboratory& lab, const Scene& scene, const Receivers& receivers, const Formula& formula) {
    std::vector<Sensor> sensors;
    std::vector<double> expected;
    for (const vec3 point : receivers.points) {
        sensors.push_back(facing(point, receivers.normal));
        expected.push_back(formula(glm::dvec3(point), glm::dvec3(receivers.normal)));
    }
    lab.add(receivers.name, scene, sensors, expected, receivers.published);
}

/// An LM-63 file of type C: a Lambert lamp of 1000 cd, every degree.
std::string lambert_file() {
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 91 1 1 2 0 0 0\n1 1 10\n";
    for (int v = 0; v <= 90; ++v) text += std::to_string(v) + " ";
    text += "\n0";
    for (int v = 0; v <= 90; ++v) text += "\n" + std::to_string(std::max(1000 * std::cos(v * pi / 180), 0.0));
    return text;
}

/// 3 m over the middle of a floor of 4 x 4 m; a triangle of points every 0.5 m from below the lamp outwards.
void point_source(Laboratory& lab) {
    LabScene room;
    room.add_rectangle("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 0);
    room.add_luminaire({0, 3, 0}, {0, -1, 0}, {1, 0, 0}, parse_photometry(lambert_file(), "lambert.ies"));
    std::vector<vec3> points;
    for (int z = 0; z <= 3; ++z)
        for (int x = z; x <= 3; ++x) points.push_back({0.5f * float(x), 0, 0.5f * float(z)});
    compare(lab, room.finish(),
            {{"5.2", "Lambert point source, floor, points A-J", "I h2 / d4"},
             points,
             {0, 1, 0},
             {111.11, 105.21, 90.02, 71.11, 99.73, 85.64, 68.06, 74.36, 59.98, 49.39}},
            [](glm::dvec3 p, glm::dvec3) { return 1000 * 9 / std::pow(9 + p.x * p.x + p.z * p.z, 2); });
}

/// 1 x 1 m of 1000 cd/m2 in the middle of the ceiling of 4 x 4 x 3 m; points down the middle of a wall and out along
/// the floor from it, every 0.5 m.
void area_source(Laboratory& lab) {
    LabScene room;
    room.add_rectangle("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 0);
    room.add_rectangle("west", {0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 0);
    room.add_rectangle("panel", {1.5f, 3, 1.5f}, {1, 0, 0}, {0, 0, 1}, 0, 1000);
    const Scene scene = room.finish();
    const Formula formula = [](glm::dvec3 point, glm::dvec3 normal) {
        return 1000 * pi * configuration_factor(point, normal, rectangle({1.5, 3, 1.5}, {1, 0, 0}, {0, 0, 1}));
    };
    compare(lab, scene,
            {{"5.3", "area source, wall, points A-F", "pi L F"},
             {{0, 2.75f, 2}, {0, 2.25f, 2}, {0, 1.75f, 2}, {0, 1.25f, 2}, {0, 0.75f, 2}, {0, 0.25f, 2}},
             {1, 0, 0},
             {32.68, 75.09, 81.38, 69.12, 53.41, 39.90}},
            formula);
    compare(lab, scene,
            {{"5.3", "area source, floor, points G-J", "pi L F"},
             {{0.25f, 0, 2}, {0.75f, 0, 2}, {1.25f, 0, 2}, {1.75f, 0, 2}},
             {0, 1, 0},
             {61.27, 79.18, 95.52, 105.89}},
            formula);
}

/// The horizontal surface of 4 x 4 m, rho 0.3, so lit that rho E = 100 lx; points on the middle of the wall over one
/// of its edges (from 0.5 m up) and on the ceiling at 3 m.
void horizontal_reflector(Laboratory& lab) {
    LabScene room;
    room.add_rectangle("S2", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 0.3f);
    room.add_sun({0, -1, 1}, float(100 / 0.3 * std::sqrt(2.0)));
    const Scene scene = room.finish();
    const Formula formula = [](glm::dvec3 point, glm::dvec3 normal) {
        return 100 * configuration_factor(point, normal, rectangle({0, 0, 0}, {4, 0, 0}, {0, 0, 4}));
    };
    compare(lab, scene,
            {{"5.6", "horizontal reflector, wall, points B-F, %", "100 F"},
             {{2, 0.75f, 0}, {2, 1.25f, 0}, {2, 1.75f, 0}, {2, 2.25f, 0}, {2, 2.75f, 0}},
             {0, 0, 1},
             {35.901, 27.992, 21.639, 16.716, 12.967}},
            formula);
    compare(lab, scene,
            {{"5.6", "horizontal reflector, ceiling, points G-J, %", "100 F"},
             {{2, 3, 0.25f}, {2, 3, 0.75f}, {2, 3, 1.25f}, {2, 3, 1.75f}},
             {0, -1, 0},
             {26.80, 30.94, 33.98, 35.57}},
            formula);
}

void add_box(LabScene& room, vec3 low, vec3 high) {
    const vec3 size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    room.add_rectangle("box bottom", low, x, z, 0);
    room.add_rectangle("box top", low + y, z, x, 0);
    room.add_rectangle("box west", low, z, y, 0);
    room.add_rectangle("box east", low + x, y, z, 0);
    room.add_rectangle("box north", low, y, x, 0);
    room.add_rectangle("box south", low + z, x, y, 0);
}

/// Height up to which a point sees the wall at z = 4 under a box of the room's width, 2.5 <= z <= 2.7, 2 <= y <= 3.
double height_seen(glm::dvec3 point) {
    double height = 3;
    for (const double edge : {2.5, 2.7})
        height = std::min(height, point.y + (2 - point.y) * (4 - point.z) / (edge - point.z));
    return height;
}

/// The wall at z = 4 of 4 x 3 m, rho 0.6, so lit (across, past the box) that rho E = 100 lx; points up the wall
/// opposite and on the ceiling at 3 m, from which a box 4 x 1 x 0.2 m hangs. It hides the wall from the last two.
void hidden_reflector(Laboratory& lab) {
    LabScene room;
    room.add_rectangle("S2", {0, 0, 4}, {0, 3, 0}, {4, 0, 0}, 0.6f);
    add_box(room, {0, 2, 2.5f}, {4, 3, 2.7f});
    const glm::dvec3 sun = glm::normalize(glm::dvec3(1, -0.1, 0.3));
    room.add_sun(vec3(sun), float(100 / 0.6 / sun.z));
    const Scene scene = room.finish();
    const Formula formula = [](glm::dvec3 point, glm::dvec3 normal) {
        const double height = height_seen(point);
        if (height < 1e-9) return 0.0;
        return 100 * configuration_factor(point, normal, rectangle({0, 0, 4}, {4, 0, 0}, {0, height, 0}));
    };
    compare(lab, scene,
            {{"5.7", "wall behind a box, wall opposite, points A-F, %", "100 F of the part seen"},
             {{2, 0.25f, 0}, {2, 0.75f, 0}, {2, 1.25f, 0}, {2, 1.75f, 0}, {2, 2.25f, 0}, {2, 2.75f, 0}},
             {0, 0, 1},
             {16.07, 16.33, 15.40, 13.32, 10.32, 7.08}},
            formula);
    compare(lab, scene,
            {{"5.7", "wall behind a box, ceiling, points G-K, %", "100 F of the part seen"},
             {{2, 3, 0.25f}, {2, 3, 0.75f}, {2, 3, 1.25f}, {2, 3, 1.75f}, {2, 3, 2.25f}},
             {0, -1, 0},
             {3.38, 3.63, 3.01, 0, 0}},
            formula);
}

Scene cube_of(double rho) {
    LabScene cube;
    cube.add_room({-2, -2, -2}, {2, 2, 2}, float(rho));
    cube.add_point({0, 0, 0}, float(10000 / (4 * pi)));
    return cube.finish();
}

/// A cube of 4 m with 10,000 lm in the middle: the mean of all faces, and what of it is reflected light (that of the
/// black cube taken off).
void interreflection(Laboratory& lab) {
    const double direct = 10000.0 / 96;
    const double black = lab.mean_of_room(cube_of(0), 64).value;
    const std::map<double, double> published = {{0.05, 5.48}, {0.1, 11.6}, {0.2, 26.0}, {0.9, 937}, {0.95, 1979}};
    for (const double rho : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
        char text[16];
        std::snprintf(text, sizeof text, "%g", rho);
        const Estimate mean = lab.mean_of_room(cube_of(rho), 64);
        const std::string what = std::string("closed cube, reflectance ") + text;
        lab.results.push_back(
            {"5.8", what + ", mean", "flux / S / (1 - rho)", direct / (1 - rho), mean.value, mean.half_width, {}});
        lab.results.push_back({"5.8",
                               what + ", mean of the reflected light",
                               "flux / S rho / (1 - rho)",
                               direct * rho / (1 - rho),
                               mean.value - black,
                               mean.half_width,
                               {}});
        if (const auto at = published.find(rho); at != published.end()) lab.results.back().published = at->second;
    }
}

}  // namespace

void add_published_cases(Laboratory& lab) {
    point_source(lab);
    area_source(lab);
    horizontal_reflector(lab);
    hidden_reflector(lab);
    interreflection(lab);
}

}  // namespace lw
