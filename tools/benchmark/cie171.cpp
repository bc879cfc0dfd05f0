#include "cie171.h"

#include <algorithm>
#include <cmath>

#include "cie171_laboratory.h"
#include "lab_scene.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

void point_source(Laboratory& lab) {
    LabScene room;
    room.add_room({0, 0, 0}, {4, 3, 4}, 0);
    room.add_point({2, 2.9f, 2}, 1000);
    const Scene scene = room.finish();
    std::vector<Sensor> sensors;
    std::vector<double> expected;
    for (const double x : {2.0, 1.0, 0.0}) {
        const double d2 = 2.9 * 2.9 + 2 * (x - 2) * (x - 2);
        sensors.push_back(facing({float(x), 0, float(x)}, {0, 1, 0}));
        expected.push_back(1000 * 2.9 / std::pow(d2, 1.5));
    }
    sensors.push_back(facing({0, 1, 2}, {1, 0, 0}));
    expected.push_back(1000 * 2 / std::pow(4 + 1.9 * 1.9, 1.5));
    lab.add({"5.2", "point source, floor and wall", "I cos a / d2"}, scene, sensors, expected);
    lab.add({"-", "point source, cylindrical illuminance", "I sin a / (pi d2)"}, scene,
            {facing({1, 1, 1}, {0, 1, 0}, Response::cylindrical)},
            {1000 * std::sqrt(2.0) / std::pow(2 + 1.9 * 1.9, 1.5) / pi});
}

/// An LM-63 file of type C: I = 1000 cos^8 g (3 + cos 2C) / 4, every degree and every 5 degrees of C.
std::string luminaire_file() {
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 91 19 1 2 0 0 0\n1 1 10\n";
    for (int v = 0; v <= 90; ++v) text += std::to_string(v) + " ";
    for (int h = 0; h <= 90; h += 5) text += "\n" + std::to_string(h);
    for (int h = 0; h <= 90; h += 5)
        for (int v = 0; v <= 90; ++v)
            text += "\n" + std::to_string(250 * std::pow(std::max(std::cos(v * pi / 180), 0.0), 8) *
                                          (3 + std::cos(2 * h * pi / 180)));
    return text;
}

void photometric_file(Laboratory& lab) {
    const Photometry photometry = parse_photometry(luminaire_file(), "cie.ies");
    LabScene room, flux;
    room.add_room({0, 0, 0}, {4, 3, 4}, 0);
    room.add_luminaire({2, 2.9f, 2}, {0, -1, 0}, {1, 0, 0}, photometry);
    flux.add_room({0, 0, 0}, {4, 4, 4}, 0);
    flux.add_luminaire({2, 3, 2}, {0.3f, -1, 0.2f}, {1, 0.3f, 0}, photometry);
    std::vector<Sensor> sensors;
    std::vector<double> expected;
    for (const glm::dvec2 at : {glm::dvec2(2, 2), glm::dvec2(3, 2), glm::dvec2(2, 3.5), glm::dvec2(1, 1)}) {
        const glm::dvec3 path(at.x - 2, -2.9, at.y - 2);
        const double d2 = glm::dot(path, path), cosine = 2.9 / std::sqrt(d2), c = std::atan2(path.z, path.x);
        sensors.push_back(facing({float(at.x), 0, float(at.y)}, {0, 1, 0}));
        expected.push_back(250 * std::pow(cosine, 8) * (3 + std::cos(2 * c)) * cosine / d2);
    }
    lab.add({"5.2", "photometric file (LM-63, type C), floor", "I(g, C) cos a / d2"}, room.finish(), sensors, expected);
    lab.add_flux({"5.4", "flux of a photometric file on all walls, lm", "2 pi 750 / 9"}, flux.finish(), 16,
                 2 * pi * 750 / 9);
}

void area_source(Laboratory& lab) {
    LabScene room;
    room.add_room({0, 0, 0}, {4, 3, 4}, 0);
    room.add_rectangle("panel", {1.5f, 2.95f, 1.5f}, {1, 0, 0}, {0, 0, 1}, 0, 1000);
    const Scene scene = room.finish();
    const Corners panel = rectangle({1.5, double(2.95f), 1.5}, {1, 0, 0}, {0, 0, 1});
    std::vector<Sensor> sensors;
    std::vector<double> expected;
    const auto sense = [&](vec3 at, vec3 normal) {
        sensors.push_back(facing(at, normal));
        expected.push_back(1000 * pi * configuration_factor(glm::dvec3(at), glm::dvec3(normal), panel));
    };
    for (const float x : {2.0f, 1.0f, 0.0f}) sense({x, 0, x}, {0, 1, 0});
    sense({0, 0.5f, 2}, {1, 0, 0});
    sense({0, 2.5f, 2}, {1, 0, 0});
    lab.add({"5.3", "area source, floor and wall", "pi L F"}, scene, sensors, expected);
}

void flux_conservation(Laboratory& lab) {
    const double area = 16;
    LabScene with_point, with_spot, with_panel;
    for (LabScene* room : {&with_point, &with_spot, &with_panel}) room->add_room({0, 0, 0}, {4, 4, 4}, 0);
    with_point.add_point({1.5f, 2.5f, 2}, 100);
    with_spot.add_spot({2, 3.9f, 2}, {0.3f, -1, 0.1f}, 1000, 20, 40);
    with_panel.add_rectangle("panel", {1.5f, 3.5f, 1.5f}, {1, 0, 0}, {0, 0, 1}, 0, 1000);
    lab.add_flux({"5.4", "flux of a point source on all walls, lm", "4 pi I"}, with_point.finish(), area, 4 * pi * 100);
    const double inner = std::cos(20 * pi / 180), outer = std::cos(40 * pi / 180);
    lab.add_flux({"5.4", "flux of a spot on all walls, lm", "2 pi I ((1 - ci) + (ci - co) / 3)"}, with_spot.finish(),
                 area, 2 * pi * 1000 * ((1 - inner) + (inner - outer) / 3));
    lab.add_flux({"5.4", "flux of an area source on all walls, lm", "pi L A"}, with_panel.finish(), area, 1000 * pi);
}

/// A horizontal plate in the sun at 45 degrees; what it sends to a plane over it and to one beside it.
void diffuse_reflection(Laboratory& lab) {
    const double lux = 10000, albedo = 0.8, reflected = albedo * lux * std::sqrt(0.5);
    for (const float side : {0.5f, 4.0f, 500.0f}) {
        LabScene plate;
        plate.add_rectangle("plate", {-side / 2, 0, -side / 2}, {0, 0, side}, {side, 0, 0}, float(albedo));
        plate.add_sun({0, -1, 1}, float(lux));
        const Corners corners = rectangle({-side / 2, 0, -side / 2}, {side, 0, 0}, {0, 0, side});
        const vec3 above(0, 2, 0), beside(-side / 2, side < 1 ? 0.25f : 3.0f, 0);
        lab.add(
            {"5.6", "diffuse plate " + std::to_string(int(side * 10)) + " dm in the sun, seen from above and beside",
             "rho E F"},
            plate.finish(), {facing(above, {0, -1, 0}), facing(beside, {1, 0, 0})},
            {reflected * configuration_factor(glm::dvec3(above), {0, -1, 0}, corners),
             reflected * configuration_factor(glm::dvec3(beside), {1, 0, 0}, corners)});
    }
}

/// The same with a black screen parallel to the sun between the plate and the plane: only what is over its edge counts.
void obstructed_reflection(Laboratory& lab) {
    const double lux = 10000, albedo = 0.8, reflected = albedo * lux * std::sqrt(0.5);
    LabScene plate;
    plate.add_rectangle("plate", {0, 0, -2}, {0, 0, 4}, {4, 0, 0}, float(albedo));
    plate.add_rectangle("screen", {-1, 0, -50}, {0, 1.5f, 0}, {0, 0, 100}, 0);
    plate.add_sun({0, -1, 1}, float(lux));
    // The ray from (-1.5, 2) over the edge at (-1, 1.5) meets the floor at x = 0.5.
    const glm::dvec3 at(-1.5, 2, 0);
    lab.add({"5.7", "the plate behind a screen", "rho E F of the part seen"}, plate.finish(),
            {facing(vec3(at), {1, 0, 0})},
            {reflected * configuration_factor(at, {1, 0, 0}, rectangle({0.5, 0, -2}, {3.5, 0, 0}, {0, 0, 4}))});
}

void interreflection(Laboratory& lab) {
    for (int tenths = 1; tenths <= 9; ++tenths) {
        const double rho = tenths / 10.0;
        LabScene sphere;
        sphere.add_sphere({0, 0, 0}, 1, 48, float(rho));
        sphere.add_point({0, 0, 0}, 100);
        lab.add({"5.8", "closed sphere, reflectance 0." + std::to_string(tenths), "I / r2 + I / R2 rho / (1 - rho)"},
                sphere.finish(), {facing({0.99f, 0, 0}, {-1, 0, 0})}, {100 / (0.99 * 0.99) + 100 * rho / (1 - rho)});
    }
}

void furnace(Laboratory& lab) {
    LabScene room;
    room.add_room({-1, -1, -1}, {1, 1, 1}, 0.5f, 100);
    const Scene scene = room.finish();
    lab.add({"-", "glowing closed room, plane and cylinder", "pi L / (1 - rho)"}, scene,
            {facing({0.2f, 0.1f, 0.3f}, {0, 1, 0}), facing({0.2f, 0.1f, 0.3f}, {0, 1, 0}, Response::cylindrical)},
            {pi * 100 / 0.5, pi * 100 / 0.5});
}

/// A black room with a hole of 1 m2 in its west wall; the sun comes in at 45 degrees.
void sun_through_window(Laboratory& lab) {
    const float albedo = 0;
    LabScene room;
    room.add_rectangle("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, albedo);
    room.add_rectangle("ceiling", {0, 3, 0}, {4, 0, 0}, {0, 0, 4}, albedo);
    room.add_rectangle("east", {4, 0, 0}, {0, 0, 4}, {0, 3, 0}, albedo);
    room.add_rectangle("north", {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, albedo);
    room.add_rectangle("south", {0, 0, 4}, {0, 3, 0}, {4, 0, 0}, albedo);
    room.add_rectangle("sill", {0, 0, 0}, {0, 1, 0}, {0, 0, 4}, albedo);
    room.add_rectangle("lintel", {0, 2, 0}, {0, 1, 0}, {0, 0, 4}, albedo);
    room.add_rectangle("left", {0, 1, 0}, {0, 1, 0}, {0, 0, 1.5f}, albedo);
    room.add_rectangle("right", {0, 1, 2.5f}, {0, 1, 0}, {0, 0, 1.5f}, albedo);
    room.add_sun({1, -1, 0}, 10000);
    const Scene scene = room.finish();
    const double lux = 10000 * std::sqrt(0.5);
    lab.add({"-", "sun through a window, in its patch", "E cos a"}, scene,
            {facing({1.5f, 0, 2}, {0, 1, 0}), facing({0.7f, 0.8f, 2}, {0, 1, 0})}, {lux, lux});
    const std::string floor = "floor: 0,0,0 to 4,0,4 spacing=0.1";
    lab.add_grid({"5.4", "mean of the floor, sun through a window", "E cos a A / S"}, scene, floor, lux / 16);
}

}  // namespace

std::vector<CieResult> run_cie171(unsigned long photons) {
    Laboratory lab(photons);
    add_published_cases(lab);
    point_source(lab);
    photometric_file(lab);
    area_source(lab);
    flux_conservation(lab);
    diffuse_reflection(lab);
    obstructed_reflection(lab);
    interreflection(lab);
    furnace(lab);
    sun_through_window(lab);
    std::stable_sort(lab.results.begin(), lab.results.end(), [](const CieResult& a, const CieResult& b) {
        return std::pair(a.section == "-", a.section) < std::pair(b.section == "-", b.section);
    });
    return lab.results;
}

}  // namespace lw
