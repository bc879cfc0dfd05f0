// Daylight through openings of a black room, the cases of CIE 171:2006, sections 5.9 to 5.14: the integral of the sky's
// luminance over the opening, with and without glass, with what is reflected by the ground, and with masks outside.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "benchmark/cie171_laboratory.h"
#include "benchmark/lab_scene.h"
#include "daylight/daylight.h"
#include "measure/traced.h"
#include "scene/surface.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double bound = 0.02;  // of every value, as in CIE 171

/// What lies between the room and the sky.
struct Opening {
    vec3 corner, u, v;
    bool glass = false;
    std::function<bool(vec3 from, vec3 direction)> is_masked = [](vec3, vec3) { return false; };
};

/// The illuminance through an opening by the midpoint rule; all of it must be before the plane of the sensor or hidden
/// from it by its cosine.
double integral(const Opening& opening, const Scene& scene, const Sensor& sensor, const Daylight& light) {
    constexpr int steps = 300;
    const SurfaceReader surfaces(scene);
    const vec3 across = cross(opening.u, opening.v) / float(steps * steps);
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const vec3 place =
                opening.corner + opening.u * ((float(i) + 0.5f) / steps) + opening.v * ((float(j) + 0.5f) / steps);
            const vec3 path = place - sensor.position, direction = normalize(path);
            const float cosine = dot(direction, sensor.normal);
            if (cosine <= 0 || opening.is_masked(sensor.position, direction)) continue;
            const double solid_angle = double(std::abs(dot(direction, across)) / dot(path, path));
            const auto glass = uint(scene.triangles.size() - 1);
            const double passed = opening.glass ? double(surfaces.passed_by(glass, vec2(0.3f), direction).y) : 1.0;
            sum += double(light.radiance(direction).y) * double(cosine) * solid_angle * passed;
        }
    return sum;
}

/// Traces with as many paths as this standard error needs, lx. They are shared by sensors at one place, each with its
/// own paths, so that several threads have work.
Traced trace_until(const Scene& scene, const RayCaster& caster, const Sensor& sensor, const Daylight& light,
                   double standard_error) {
    constexpr size_t parts = 8;
    const std::vector<Sensor> copies(parts, sensor);
    TraceSettings trace;
    trace.paths = 4'000, trace.daylight = &light;
    const auto mean = [&] {
        Traced sum;
        for (const Traced& part : trace_sensors(scene, caster, {}, copies, trace)) {
            sum.lux += part.lux / parts;
            sum.standard_error += part.standard_error * part.standard_error / (parts * parts);
        }
        return sum.standard_error = std::sqrt(sum.standard_error), sum;
    };
    const double more = std::pow(mean().standard_error / standard_error, 2);
    trace.paths = uint64_t(4'000 * std::max(1.0, 1.1 * more)), trace.seed = 2;
    return mean();
}

/// Adds the opening's glass, last of all, and traces.
void expect_integrals(LabScene lab, const Opening& opening, const std::vector<Sensor>& sensors,
                      const std::string& what) {
    if (opening.glass) lab.add_rectangle("glass", opening.corner, opening.u, opening.v, 1);
    Scene scene = lab.finish();
    if (opening.glass) {
        Material& glass = scene.materials.back();
        glass.transmission = 1, glass.roughness = 0, glass.specular = 1, glass.ior = 1.5f;
        glass.flags |= material_thin | material_double_sided;
    }
    const RayCaster caster(scene);
    for (int type : {1, 7, 12}) {
        DaylightSettings settings;
        settings.shape = cie_sky(type);
        settings.diffuse = 10'000, settings.altitude = 60, settings.azimuth = 200;
        settings.ground_albedo = 0.3;
        const Daylight light(settings);
        for (size_t i = 0; i < sensors.size(); ++i) {
            const double expected = integral(opening, scene, sensors[i], light);
            ASSERT_GT(expected, 1) << what;
            const Traced traced = trace_until(scene, caster, sensors[i], light, bound / 4 * expected);
            EXPECT_NEAR(traced.lux / expected, 1, std::min(bound, 4 * traced.standard_error / expected + 0.002))
                << what << ", sky " << type << ", sensor " << i;
            EXPECT_LT(traced.standard_error, bound / 3 * expected) << what << ", sky " << type << ", sensor " << i;
        }
    }
}

/// A black room of 4 x 3 x 4 m with an opening of 1 or 4 m in the roof, 0.2 m thick in the standard, a sheet here.
TEST(Openings, InARoofShowWhatTheSkyGives) {
    for (const float side : {1.0f, 3.9f})
        for (const bool glass : {false, true}) {
            const float a = 2 - side / 2, b = 2 + side / 2;
            LabScene lab;
            lab.add_rectangle("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 0);
            lab.add_rectangle("west", {0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 0);
            lab.add_rectangle("east", {4, 0, 0}, {0, 0, 4}, {0, 3, 0}, 0);
            lab.add_rectangle("north", {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0);
            lab.add_rectangle("south", {0, 0, 4}, {0, 3, 0}, {4, 0, 0}, 0);
            lab.add_rectangle("roof 1", {0, 3, 0}, {a, 0, 0}, {0, 0, 4}, 0);
            lab.add_rectangle("roof 2", {b, 3, 0}, {4 - b, 0, 0}, {0, 0, 4}, 0);
            lab.add_rectangle("roof 3", {a, 3, 0}, {side, 0, 0}, {0, 0, a}, 0);
            lab.add_rectangle("roof 4", {a, 3, b}, {side, 0, 0}, {0, 0, 4 - b}, 0);
            Opening opening{{a, 3, a}, {side, 0, 0}, {0, 0, side}};
            opening.glass = glass;
            const std::vector<Sensor> sensors{facing({2, 0.002f, 2}, {0, 1, 0}), facing({0.5f, 0.002f, 1}, {0, 1, 0}),
                                              facing({0.002f, 1.5f, 2}, {1, 0, 0})};
            expect_integrals(lab, opening, sensors, glass ? "glazed roof" : "open roof");
        }
}

/// A black room whose south wall has a window of 2 x 1 m, 1 m above the floor.
LabScene room_with_window() {
    LabScene lab;
    lab.add_rectangle("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 0);
    lab.add_rectangle("ceiling", {0, 3, 0}, {4, 0, 0}, {0, 0, 4}, 0);
    lab.add_rectangle("west", {0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 0);
    lab.add_rectangle("east", {4, 0, 0}, {0, 0, 4}, {0, 3, 0}, 0);
    lab.add_rectangle("north", {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0);
    lab.add_rectangle("sill", {0, 0, 4}, {0, 1, 0}, {4, 0, 0}, 0);
    lab.add_rectangle("lintel", {0, 2, 4}, {0, 1, 0}, {4, 0, 0}, 0);
    lab.add_rectangle("left", {0, 1, 4}, {0, 1, 0}, {1, 0, 0}, 0);
    lab.add_rectangle("right", {3, 1, 4}, {0, 1, 0}, {1, 0, 0}, 0);
    return lab;
}

const Opening window{{1, 1, 4}, {2, 0, 0}, {0, 1, 0}};

std::vector<Sensor> sensors_in_room() {
    return {facing({2, 0.002f, 3}, {0, 1, 0}), facing({2, 0.002f, 1}, {0, 1, 0}), facing({2, 2.998f, 3}, {0, -1, 0}),
            facing({0.5f, 1.5f, 0.002f}, {0, 0, 1})};
}

TEST(Openings, InAFacadeShowSkyAndGround) {
    for (const bool glass : {false, true}) {
        Opening opening = window;
        opening.glass = glass;
        expect_integrals(room_with_window(), opening, sensors_in_room(), glass ? "glazed facade" : "open facade");
    }
}

/// True when a ray meets a rectangle with edges along the axes.
bool meets(vec3 from, vec3 direction, int axis, float plane, vec3 low, vec3 high) {
    const float distance = (plane - from[axis]) / direction[axis];
    if (!(distance > 0)) return false;
    const vec3 at = from + direction * distance;
    for (int other = 0; other < 3; ++other)
        if (other != axis && (at[other] < low[other] || at[other] > high[other])) return false;
    return true;
}

TEST(Openings, BehindMasksShowTheRest) {
    LabScene below = room_with_window(), behind = room_with_window();
    Opening with_overhang = window, with_screen = window;
    below.add_rectangle("overhang", {-4, 2.2f, 4}, {12, 0, 0}, {0, 0, 1}, 0);
    with_overhang.is_masked = [](vec3 from, vec3 direction) {
        return meets(from, direction, 1, 2.2f, {-4, 0, 4}, {8, 0, 5});
    };
    behind.add_rectangle("screen", {-20, -1, 8}, {44, 0, 0}, {0, 5, 0}, 0);
    with_screen.is_masked = [](vec3 from, vec3 direction) {
        return meets(from, direction, 2, 8, {-20, -1, 0}, {24, 4, 0});
    };
    std::vector<Sensor> sensors = sensors_in_room();
    expect_integrals(below, with_overhang, sensors, "overhang");
    sensors.erase(sensors.begin() + 2, sensors.end());  // what the others see is all screen
    expect_integrals(behind, with_screen, {sensors[0]}, "screen");
}

TEST(Openings, UnderAnEvenSkyHaveTheClosedForm) {
    DaylightSettings settings;
    settings.shape = cie_sky(5), settings.diffuse = 10'000, settings.ground_albedo = 0.3;
    LabScene lab = room_with_window();
    const Scene scene = lab.finish();
    const Sensor sensor = sensors_in_room()[0];
    const double factor = configuration_factor(glm::dvec3(sensor.position), glm::dvec3(sensor.normal),
                                               rectangle({1, 1, 4}, {2, 0, 0}, {0, 1, 0}));
    EXPECT_NEAR(integral(window, scene, sensor, Daylight(settings)), 10'000 * factor, 1e-3 * 10'000 * factor);
    EXPECT_NEAR(pi * double(Daylight(settings).radiance({0, 1, 0}).y), 10'000, 1);
}

}  // namespace
}  // namespace lw
