// The path tracer under daylight against closed forms: open planes, furnaces, half a sun.
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "benchmark/lab_scene.h"
#include "daylight/options.h"
#include "measure/traced.h"
#include "shaders/color.h"
#include "trace/path_tracer.h"
#include "trace/reference.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

DaylightSettings sky(int cie_type, double diffuse, double direct = 0, double altitude = 40) {
    DaylightSettings settings;
    settings.shape = cie_sky(cie_type);
    settings.diffuse = diffuse, settings.direct = direct;
    settings.altitude = altitude, settings.azimuth = 140;
    return settings;
}

/// A small black plate in the open, 1 m below the origin.
Scene open_field() {
    LabScene lab;
    lab.add_rectangle("plate", {-0.1f, -1, -0.1f}, {0, 0, 0.2f}, {0.2f, 0, 0}, 0);
    return lab.finish();
}

Traced lux_at_origin(const Scene& scene, const Daylight& light, vec3 normal, uint64_t paths = 40'000) {
    const RayCaster caster(scene);
    TraceSettings settings;
    settings.paths = paths, settings.daylight = &light;
    const Sensor sensor{vec3(0), normal, Response::planar};
    return trace_sensors(scene, caster, {}, std::span(&sensor, 1), settings)[0];
}

void expect_lux(const Traced& traced, double expected, const std::string& what) {
    EXPECT_NEAR(traced.lux, expected, 4 * traced.standard_error + 5e-4 * expected) << what;
    EXPECT_LT(traced.standard_error, 0.006 * expected) << what;
}

TEST(Daylight, OnAnOpenPlaneIsWhatTheSkyAndTheSunAreSetTo) {
    const Scene scene = open_field();
    for (int type = 1; type <= 15; ++type)
        for (double altitude : {3.0, 40.0, 88.0}) {
            const Daylight light(sky(type, 10'000, 0, altitude));
            expect_lux(lux_at_origin(scene, light, {0, 1, 0}), 10'000, "sky " + std::to_string(type));
        }
    const Daylight with_sun(sky(12, 10'000, 50'000));
    expect_lux(lux_at_origin(scene, with_sun, {0, 1, 0}), 10'000 + 50'000 * std::sin(40 * pi / 180), "sky and sun");
}

TEST(Daylight, FacingTheSunIsTheDirectIlluminance) {
    const Daylight light(sky(12, 0, 50'000));
    const double sine = std::sin(40 * pi / 180), from_ground = 0.2 * 50'000 * sine * (1 - sine) / 2;
    expect_lux(lux_at_origin(open_field(), light, light.to_sun()), 50'000 + from_ground, "sun and ground");
}

TEST(Daylight, OnAVerticalPlaneHasClosedForms) {
    const Scene scene = open_field();
    DaylightSettings even = sky(5, 10'000);
    even.ground_albedo = 0.3;
    expect_lux(lux_at_origin(scene, Daylight(even), {0, 0, 1}), 5000 + 0.3 * 5000, "uniform sky and its ground");
    // Of an overcast sky: the integral of 2 (1 + a exp(b / cos Z)) sin^2 Z over Z, and on a horizontal plane that of
    // 2 pi (1 + a exp(b / cos Z)) sin Z cos Z.
    double upright = 0, level = 0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) * pi / 2 / steps, value = 1 + 4 * std::exp(-0.7 / std::cos(z));
        upright += 2 * value * std::sin(z) * std::sin(z);
        level += 2 * pi * value * std::sin(z) * std::cos(z);
    }
    expect_lux(lux_at_origin(scene, Daylight(sky(1, 10'000)), {1, 0, 0}), 10'000 * upright / level + 0.2 * 5000,
               "overcast sky");
}

/// The mean radiance that rays from `eye` see in a narrow cone, cd/m2, and its standard error.
Traced radiance_seen(const Scene& scene, const Daylight& light, vec3 eye, vec3 towards) {
    const RayCaster caster(scene);
    const SkySampler sampler(scene, light);
    const PathTracer tracer(scene, caster, {}, &sampler);
    const mat3 frame = frame_around(normalize(towards - eye));
    constexpr int count = 20'000;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        Rng rng(3, 4, uint64_t(i));
        const vec3 direction = frame * direction_of(1 - 0.01f * rng.next(), rng.next());
        const double value = precise_luminance(tracer.radiance(eye, direction, rng));
        sum += value, squares += value * value;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

TEST(Daylight, IsAFurnaceWhereTheGroundIsAsBrightAsTheSky) {
    DaylightSettings settings = sky(5, 1000 * pi);
    settings.ground_albedo = 1;
    const Daylight light(settings);
    for (const bool mirror : {false, true}) {
        LabScene lab;
        lab.add_sphere({0, 0, 0}, 1, 12, 1);
        Scene scene = lab.finish();
        if (mirror) scene.materials[0].metallic = 1, scene.materials[0].roughness = 0;
        const Traced seen = radiance_seen(scene, light, {0.5f, 4, 3}, {0, 0, 0});
        EXPECT_NEAR(seen.lux, 1000, 4 * seen.standard_error + 1) << mirror;
        EXPECT_LT(seen.standard_error, 5) << mirror;
    }
    LabScene lab;  // a white room without a roof
    lab.add_rectangle("floor", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 1);
    lab.add_rectangle("west", {-1, 0, -1}, {0, 2, 0}, {0, 0, 2}, 1);
    lab.add_rectangle("east", {1, 0, -1}, {0, 0, 2}, {0, 2, 0}, 1);
    lab.add_rectangle("north", {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, 1);
    lab.add_rectangle("south", {-1, 0, 1}, {0, 2, 0}, {2, 0, 0}, 1);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    TraceSettings trace;
    trace.paths = 40'000, trace.daylight = &light;
    const Sensor sensors[] = {{{0.5f, 0.01f, 0.2f}, {0, 1, 0}, Response::planar},
                              {{-0.99f, 0.3f, 0.6f}, {1, 0, 0}, Response::planar}};
    for (const Traced& traced : trace_sensors(scene, caster, {}, sensors, trace))
        expect_lux(traced, 1000 * pi, "white room");
}

TEST(Daylight, OfASunHalfBehindAnEdgeIsHalf) {
    DaylightSettings settings = sky(5, 0, 20'000, 30);
    settings.azimuth = 180, settings.ground_albedo = 0;
    const Daylight light(settings);
    LabScene lab;  // south is +Z: the plate hides all that is east of the middle of the sun
    lab.add_rectangle("plate", {0, 0, 10}, {20, 0, 0}, {0, 20, 0}, 0);
    expect_lux(lux_at_origin(lab.finish(), light, {0, 1, 0}), 20'000 * 0.5 / 2, "half a sun");
}

TEST(Daylight, OfTheSunByAMirrorAddsToThatOfTheSun) {
    DaylightSettings settings = sky(5, 0, 20'000, 45);
    settings.azimuth = 90, settings.ground_albedo = 0;
    const Daylight light(settings);
    LabScene lab;
    lab.add_rectangle("floor", {0, 0, -20}, {0, 0, 40}, {40, 0, 0}, 0);
    lab.add_rectangle("mirror", {0, 0, -20}, {0, 40, 0}, {0, 0, 40}, 1);
    Scene scene = lab.finish();
    scene.materials.back().metallic = 1, scene.materials.back().roughness = 0;
    const RayCaster caster(scene);
    const SkySampler sampler(scene, light);
    ASSERT_TRUE(has_caustics(scene, {}, &sampler));
    const Caustics caustics(scene, caster, {}, {1'000'000, 2, 1, 0, &sampler});
    const PathTracer tracer(scene, caster, {}, &sampler);
    double lux = 0;
    constexpr int paths = 20'000;
    for (int i = 0; i < paths; ++i) {
        Rng rng(7, 8, uint64_t(i));
        lux += precise_luminance(tracer.irradiance({10, 0.001f, 0}, {0, 1, 0}, rng, &caustics)) / paths;
    }
    EXPECT_NEAR(lux, 2 * 20'000 * std::sqrt(0.5), 0.02 * 2 * 20'000 * std::sqrt(0.5));
}

TEST(SkySampler, PicksDirectionsWithTheDensityItTells) {
    const Scene scene = open_field();
    const Daylight light(sky(13, 10'000, 0, 20));
    const SkySampler sampler(scene, light);
    constexpr int count = 200'000;
    double even = 0, up = 0, near_sun = 0, expected_near_sun = 0;
    for (int i = 0; i < count; ++i) {
        Rng rng(5, 6, uint64_t(i));
        const vec3 uniform = direction_of(2 * rng.next() - 1, rng.next());
        even += 4 * pi * double(sampler.pdf(uniform)) / count;
        expected_near_sun += (dot(uniform, light.to_sun()) > 0.9f ? 4 * pi * double(sampler.pdf(uniform)) : 0) / count;
        const float cell = rng.next(), u = rng.next(), v = rng.next();
        const Incident in = sampler.arrive(vec3(0), {cell, u, v});
        EXPECT_NEAR(length(in.to_light), 1, 1e-5);
        EXPECT_EQ(in.pdf, sampler.pdf(in.to_light));
        up += (in.to_light.y >= 0) / double(count);
        near_sun += (dot(in.to_light, light.to_sun()) > 0.9f) / double(count);
    }
    EXPECT_NEAR(even, 1, 0.02);
    EXPECT_NEAR(near_sun, expected_near_sun, 0.01);
    EXPECT_GT(near_sun, 0.15);
    EXPECT_GT(up, 0.75);
}

TEST(Daylight, GivesTheSamePictureOnAnyNumberOfThreads) {
    const Scene scene = open_field();
    const Daylight light(sky(12, 10'000, 50'000));
    const RayCaster caster(scene);
    Camera camera;
    camera.position = {0, 0.5f, 0.5f};
    ReferenceSettings settings;
    settings.width = 24, settings.height = 16, settings.samples = 3, settings.daylight = &light;
    const Reference many = render_reference(scene, caster, camera, {}, settings);
    const ThreadLimit one(1);
    const Reference alone = render_reference(scene, caster, camera, {}, settings);
    for (const char* channel : {"R", "G", "B", "illuminance"})
        EXPECT_EQ(many.image.find(channel)->values, alone.image.find(channel)->values) << channel;
}

}  // namespace
}  // namespace lw
