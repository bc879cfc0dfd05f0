// Photons through glass against the path tracer, against light counted from the lamps, and their own energy balance.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "photons/shoot.h"
#include "scene/gltf.h"
#include "shaders/color.h"
#include "trace/caustics.h"
#include "trace/path_tracer.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

uint lamp_named(const Scene& scene, const std::string& name) {
    for (uint i = 0; i < scene.light_names.size(); ++i)
        if (scene.light_names[i] == name) return i;
    ADD_FAILURE() << "no lamp " << name;
    return 0;
}

Material& material_named(Scene& scene, const std::string& name) {
    for (size_t i = 0; i < scene.material_names.size(); ++i)
        if (scene.material_names[i] == name) return scene.materials[i];
    ADD_FAILURE() << "no material " << name;
    return scene.materials[0];
}

TEST(GlassPhotons, EveryLampBalancesInRoomsOfEveryMaterial) {
    for (const char* name : {"glass_sphere.gltf", "metal_sculpture.gltf", "glossy_floor.gltf"}) {
        const Scene scene = load_gltf(file_in_data(name));
        const RayCaster caster(scene);
        const Photons photons = shoot_photons(scene, caster, {.photons = 50000, .direct_in_photons = true});
        for (const LightBalance& b : photons.lights) {
            EXPECT_NEAR((b.absorbed + b.escaped) / b.flux_out, 1, 1e-9) << name;
            EXPECT_LT(b.escaped, 1e-4 * b.flux_out) << name;  // the rooms are closed
        }
    }
}

/// Lux on a square of the floor around (x, z), by path class, of photons of one lamp at its full power.
std::array<double, 4> floor_lux(const Scene& scene, const Photons& photons, uint lamp, float x, float z, float half) {
    const vec3 origin(scene.origin);
    std::array<double, 4> lux{};
    for (const Photon& p : photons.records) {
        const vec3 at = p.position + origin;
        if (p.light() != lamp || at.y > 1e-3f || std::abs(at.x - x) > half || std::abs(at.z - z) > half) continue;
        lux[p.path()] += precise_luminance(p.flux * scene.lights[lamp].intensity) / double(4 * half * half);
    }
    return lux;
}

/// Mean lux of the path tracer over the square.
double traced_lux(const Scene& scene, const RayCaster& caster, uint lamp, float x, float z, float half, int samples,
                  const Caustics* caustics, double& error) {
    std::vector<vec3> weights(scene.lights.size(), vec3(0));
    weights[lamp] = scene.lights[lamp].intensity;
    const PathTracer tracer(scene, caster, weights);
    double sum = 0, sum2 = 0;
    for (int i = 0; i < samples; ++i) {
        Rng rng(4, 4, uint64_t(i));
        const vec3 world(x + half * (2 * rng.next() - 1), 0, z + half * (2 * rng.next() - 1));
        const vec3 point = caster.offset(world - vec3(scene.origin), vec3(0, 1, 0));
        const double lux = precise_luminance(tracer.irradiance(point, vec3(0, 1, 0), rng, caustics));
        sum += lux, sum2 += lux * lux;
    }
    error = std::sqrt(std::max(0.0, sum2 / samples - sum * sum / samples / samples) / samples);
    return sum / samples;
}

struct Square {
    const char* lamp;
    float x, z, half;
};

TEST(GlassPhotons, BringTheLightOfThePathTracerThroughBallAndSheet) {
    // Under the ball: its caustic and the ring of its shadow; behind the sheet; in the open. Spot, bulb and panel.
    const Scene scene = load_gltf(file_in_data("glass_sphere.gltf"));
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000000, .direct_in_photons = true});
    for (const Square& at : {Square{"spot", 0, 0, 0.1f}, Square{"spot", 0.3f, 0.3f, 0.1f}, Square{"bulb", 0, 0, 0.2f},
                             Square{"bulb", 0.2f, -0.4f, 0.2f}, Square{"panel", 0, 0, 0.2f},
                             Square{"panel", -0.5f, 0.4f, 0.2f}, Square{"panel", 0.7f, -0.3f, 0.2f}}) {
        const uint lamp = lamp_named(scene, at.lamp);
        std::vector<vec3> weights(scene.lights.size(), vec3(0));
        weights[lamp] = scene.lights[lamp].intensity;
        const Caustics caustics(scene, caster, weights, {1000000, 0.006f, 7, 0});
        double error = 0;
        const double truth = traced_lux(scene, caster, lamp, at.x, at.z, at.half, 15000, &caustics, error);
        const std::array<double, 4> lux = floor_lux(scene, photons, lamp, at.x, at.z, at.half);
        EXPECT_LT(error, 0.06 * truth) << at.lamp << " at " << at.x << " " << at.z;
        EXPECT_NEAR((lux[0] + lux[1] + lux[2] + lux[3]) / truth, 1, 0.02 + 4 * error / truth)
            << at.lamp << " at " << at.x << " " << at.z << ": " << lux[0] << " + " << lux[1] << " + " << lux[2]
            << " lx, traced " << truth;
    }
}

TEST(GlassPhotons, BringTheLightOfThePathTracerByMetalAndGloss) {
    struct Room {
        const char* file;
        Square at;
    };
    for (const Room& room : {Room{"metal_sculpture.gltf", {"panel", 0, 0.6f, 0.3f}},
                             Room{"metal_sculpture.gltf", {"spot", 0.6f, 0.6f, 0.3f}},
                             Room{"glossy_floor.gltf", {"bulb", -0.8f, 0.5f, 0.4f}},
                             Room{"glossy_floor.gltf", {"panel", 1, 0.5f, 0.4f}}}) {
        const Scene scene = load_gltf(file_in_data(room.file));
        const RayCaster caster(scene);
        const Photons photons = shoot_photons(scene, caster, {.photons = 800000, .direct_in_photons = true});
        const Square& at = room.at;
        const uint lamp = lamp_named(scene, at.lamp);
        std::vector<vec3> weights(scene.lights.size(), vec3(0));
        weights[lamp] = scene.lights[lamp].intensity;
        const Caustics caustics(scene, caster, weights, {500000, 0.01f, 7, 0});
        double error = 0;
        const double truth = traced_lux(scene, caster, lamp, at.x, at.z, at.half, 15000, &caustics, error);
        const std::array<double, 4> lux = floor_lux(scene, photons, lamp, at.x, at.z, at.half);
        EXPECT_NEAR((lux[0] + lux[1] + lux[2] + lux[3]) / truth, 1, 0.02 + 4 * error / truth)
            << room.file << " " << at.lamp;
    }
}

TEST(GlassPhotons, ThroughASheetLightStaysDirectAndThroughABallItIsCaustic) {
    const Scene scene = load_gltf(file_in_data("glass_sphere.gltf"));
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 500000, .direct_in_photons = true});
    const std::array<double, 4> ball = floor_lux(scene, photons, lamp_named(scene, "spot"), 0, 0, 0.05f);
    EXPECT_EQ(ball[path_direct], 0);
    EXPECT_GT(ball[path_caustic], 5 * ball[path_indirect]);
    const std::array<double, 4> sheet = floor_lux(scene, photons, lamp_named(scene, "bulb"), 0.1f, -0.4f, 0.2f);
    EXPECT_GT(sheet[path_direct], sheet[path_caustic] * 3);
    const Photons others = shoot_photons(scene, caster, {.photons = 100000});
    for (const Photon& p : others.records) ASSERT_NE(p.path(), path_direct);
}

TEST(GlassPhotons, ALampBehindASolidCoverLightsTheRoom) {
    // The spot inside the clear ball, as a cover: all its light leaves, none of it direct, the floor gets the same
    // flux.
    Scene scene = load_gltf(file_in_data("glass_sphere.gltf"));
    material_named(scene, "solid").absorption = vec3(0);
    const uint spot = lamp_named(scene, "spot");
    scene.lights[spot].position = vec3(0, 0.45f, 0) - vec3(scene.origin);
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 300000, .direct_in_photons = true});
    double first = 0, direct = 0;
    for (const Photon& p : photons.records) {
        if (p.light() != spot || p.path() == path_indirect) continue;
        first += precise_luminance(p.flux);
        direct += p.path() == path_direct ? precise_luminance(p.flux) : 0;
    }
    EXPECT_EQ(direct, 0);
    EXPECT_NEAR(first / photons.lights[spot].flux_out, 1, 0.01);
}

TEST(GlassPhotons, BentNormalsThrowTheSameLightForPhotonsAndPaths) {
    // The floor's normals lean by 17 degrees, no way comes from below their horizon; what the bulb sends by way of it
    // to a square of the ceiling.
    Scene scene = load_gltf(file_in_data("glossy_floor.gltf"));
    for (size_t t = 0; t < scene.triangles.size(); ++t)
        if (scene.object_names[scene.triangle_objects[t]] == "floor")
            for (int c = 0; c < 3; ++c) scene.normals[scene.triangles[t][c]] = normalize(vec3(-0.3f, 1, 0));
    for (const char* black : {"white", "red", "blue"}) material_named(scene, black).base_color = vec3(0);
    material_named(scene, "polished").roughness = 0.6f;
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000000});
    const uint bulb = lamp_named(scene, "bulb");
    const vec3 origin(scene.origin), down(0, -1, 0);
    std::vector<vec3> weights(scene.lights.size(), vec3(0));
    weights[bulb] = scene.lights[bulb].intensity;
    const PathTracer tracer(scene, caster, weights);
    for (const vec2 at : {vec2(0.3f, 1), vec2(1.4f, -1)}) {
        double counted = 0, traced = 0;
        for (const Photon& p : photons.records) {
            const vec3 place = p.position + origin;
            if (p.light() != bulb || p.path() != path_indirect || place.y < 2.599f) continue;
            if (std::abs(place.x - at.x) < 0.5f && std::abs(place.z - at.y) < 0.5f)
                counted += precise_luminance(p.flux * weights[bulb]) / 1.0;
        }
        constexpr int samples = 60000;
        for (int i = 0; i < samples; ++i) {
            Rng rng(6, 6, uint64_t(i));
            const vec3 world(at.x + 0.5f * (2 * rng.next() - 1), 2.6f, at.y + 0.5f * (2 * rng.next() - 1));
            const vec3 point = caster.offset(world - origin, down), to_bulb = scene.lights[bulb].position - point;
            const double direct =
                precise_luminance(weights[bulb]) * double(dot(to_bulb, down)) / std::pow(length(to_bulb), 3);
            traced += (precise_luminance(tracer.irradiance(point, down, rng)) - direct) / samples;
        }
        EXPECT_NEAR(counted / traced, 1, 0.05) << at.x;
    }
}

TEST(GlassPhotons, LightCaughtByTotalReflectionEnds) {
    // A bulb close under the surface of a clear ball: most of its light runs around inside (R / (n r) < 1).
    Scene scene = load_gltf(file_in_data("glass_sphere.gltf"));
    material_named(scene, "solid").absorption = vec3(0);
    material_named(scene, "sheet").base_color = vec3(1);
    const uint bulb = lamp_named(scene, "bulb");
    scene.lights[bulb].position = vec3(0.24f, 0.45f, 0) - vec3(scene.origin);
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 20000, .direct_in_photons = true});
    const LightBalance& b = photons.lights[bulb];
    EXPECT_NEAR((b.absorbed + b.escaped) / b.flux_out, 1, 1e-9);
    double caustic = 0;
    for (const Photon& p : photons.records)
        if (p.light() == bulb && p.path() == path_caustic) caustic += precise_luminance(p.flux);
    EXPECT_GT(caustic, 0.27 * b.flux_out);  // what meets the surface below the critical angle leaves at once: 28 %
    EXPECT_LT(caustic, 0.5 * b.flux_out);
    const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
    for (int i = 0; i < 2000; ++i) {
        Rng rng(8, 8, uint64_t(i));
        const vec3 along(0, 0.1f * rng.next(), 1);
        EXPECT_TRUE(std::isfinite(tracer.radiance(scene.lights[bulb].position, normalize(along), rng).y));
    }
}

TEST(GlassPhotons, BlendedSurfacesPassTheSameShareToPhotonsAndShadowRays) {
    Scene scene = load_gltf(file_in_data("glass_sphere.gltf"));
    Material& sheet = material_named(scene, "sheet");
    sheet.transmission = 0, sheet.flags = material_alpha_blend | material_double_sided, sheet.alpha = 0.3f;
    const RayCaster caster(scene);
    const vec3 origin(scene.origin);
    const vec3 passed = caster.transmittance(vec3(0.8f, 0.8f, -0.4f) - origin, vec3(0.1f, 0.1f, -0.4f) - origin);
    EXPECT_NEAR(passed.y, 0.7f, 1e-6f);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000000, .direct_in_photons = true});
    double error = 0;
    const uint bulb = lamp_named(scene, "bulb");
    const double truth = traced_lux(scene, caster, bulb, 0.2f, -0.4f, 0.2f, 20000, nullptr, error);
    const std::array<double, 4> lux = floor_lux(scene, photons, bulb, 0.2f, -0.4f, 0.2f);
    EXPECT_NEAR((lux[0] + lux[1]) / truth, 1, 0.03 + 4 * error / truth);
}

}  // namespace
}  // namespace lw
