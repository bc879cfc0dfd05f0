#include "gather/renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "maps/build.h"
#include "photons/shoot.h"
#include "scene/gltf.h"
#include "trace/build_bvh.h"
#include "trace/reference.h"

namespace lw {
namespace {

/// Two rectangles facing +Z: the left half of the view at z = -2, all of it at z = -4. The left one glows.
Scene two_walls() {
    Scene scene;
    scene.positions = {{-9, -9, -2},   {0, -9, -2},   {0, 9, -2},   {-9, 9, -2},
                       {-19, -19, -4}, {19, -19, -4}, {19, 19, -4}, {-19, 19, -4}};
    scene.normals.assign(8, vec3(0, 0, 1));
    scene.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    scene.triangle_objects = {0, 0, 1, 1};
    scene.objects = {{0, 0}, {1, -1}};
    Material plain{};
    plain.base_color = vec3(0.5f);
    plain.alpha = 1;
    plain.roughness = 1;
    plain.ior = 1.5f;
    for (TextureSlot* slot : {&plain.base_color_texture, &plain.metallic_roughness_texture, &plain.normal_texture,
                              &plain.emissive_texture, &plain.transmission_texture})
        *slot = {-1, 0, {1, 0, 0}, {0, 1, 0}};
    scene.materials = {plain, plain};
    scene.materials[0].emissive = vec3(3, 2, 1);
    Light light{};
    light.type = light_mesh;
    light.intensity = vec3(3, 2, 1);
    scene.lights = {light};
    scene.cameras = {Camera{}};
    return scene;
}

PhotonMap no_photons() {
    PhotonMap map;
    map.settings.radius = 0.1f;
    return map;
}

/// Photons every centimetre on the front of the right part of the back wall: 1 lx per unit of the light's intensity.
PhotonMap even_photons() {
    PhotonMap map = no_photons();
    map.grid_of_side = {no_grid, no_grid, no_grid, no_grid, 0, no_grid, 0, no_grid};
    SurfaceGrid grid{};
    grid.origin = vec3(0, -1, -4);
    grid.cell_size = 0.1f;
    grid.u_axis = vec3(1, 0, 0);
    grid.v_axis = vec3(0, 1, 0);
    grid.normal = vec3(0, 0, 1);
    grid.columns = grid.rows = 20;
    grid.quantum = vec3(0.001f);
    grid.radius = 0.3f;
    map.grids = {grid};
    for (uint cell = 0; cell < 400; ++cell) {
        map.cell_starts.push_back(uint(map.places.size()));
        for (uint i = 0; i < 100; ++i) {
            const uint u = (cell % 20) * 100 + (i % 10) * 10 + 5;
            const uint v = (cell / 20) * 100 + (i / 10) * 10 + 5;
            map.places.push_back({u | v << 16, 0});
            map.fluxes.push_back(1u | 1u << 9 | 1u << 18 | 24u << 27);  // 1, 1, 1
        }
    }
    map.cell_starts.push_back(uint(map.places.size()));
    map.flux_scale = 1e4f;  // each 1e-4 lm on 1e-4 m2: 1 lx per unit of intensity
    return map;
}

Rendering picture_of(const Device& device, const Scene& scene, const PhotonMap& map, RenderSettings settings,
                     ResidentSettings resident_settings = {}) {
    const Resident resident(device, scene, map, {}, resident_settings);
    Renderer renderer(device, resident, 64, 48);
    return renderer.render(scene.cameras[0], settings);
}

}  // namespace

TEST(Renderer, SeesTheRightTriangleBarycentricsAndDepth) {
    const Device device({"", true});
    const Scene scene = two_walls();
    const PhotonMap dark = no_photons();
    const Resident resident(device, scene, dark);
    Renderer renderer(device, resident, 64, 48);
    const Rendering picture = renderer.render(scene.cameras[0], {});
    const std::vector<VisibleSample> visible = renderer.visible_samples();
    const float half = std::tan(0.5f * scene.cameras[0].yfov);
    for (size_t i = 0; i < visible.size(); ++i) {
        const float z = i % 64 < 32 ? 2.0f : 4.0f;
        const vec3 expected((float(i % 64) - 31.5f) / 24 * half * z, (23.5f - float(i / 64)) / 24 * half * z, -z);
        ASSERT_LT(visible[i].triangle, 4u);
        EXPECT_EQ(visible[i].triangle / 2, i % 64 < 32 ? 0u : 1u) << i;
        const uvec3 t = scene.triangles[visible[i].triangle];
        const vec2 b = visible[i].barycentrics;
        const vec3 p = scene.positions[t.x] * (1 - b.x - b.y) + scene.positions[t.y] * b.x + scene.positions[t.z] * b.y;
        EXPECT_LT(length(p - expected), 2e-3f) << i;
        EXPECT_NEAR(picture.image.find("depth")->values[i], z, 1e-4f) << i;
        EXPECT_EQ(picture.image.find("triangle")->values[i], float(visible[i].triangle)) << i;
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(Renderer, AndTheReferenceSeeNothingBeforeTheNearPlane) {
    const Device device({"", true});
    Scene scene = two_walls();
    scene.cameras[0].near = 2.5f;
    scene.lights.clear();
    for (Material& m : scene.materials) m.emissive = vec3(0);
    for (Object& o : scene.objects) o.light = -1;
    const PhotonMap dark = no_photons();
    const Image picture = picture_of(device, scene, dark, {}).image;
    ReferenceSettings settings;
    settings.width = 64, settings.height = 48, settings.samples = 1;
    const RayCaster caster(scene);
    const Image truth = render_reference(scene, caster, scene.cameras[0], {}, settings).image;
    for (size_t i = 0; i < size_t(64 * 48); ++i) {
        EXPECT_GE(picture.find("triangle")->values[i], 2) << i;
        EXPECT_EQ(picture.find("triangle")->values[i], truth.find("triangle")->values[i]) << i;
        EXPECT_NEAR(picture.find("depth")->values[i], 4, 1e-4f) << i;
        EXPECT_NEAR(truth.find("depth")->values[i], 4, 1e-4f) << i;
    }
}

TEST(Renderer, ShowsTheGlowOfADimmedLampAndNothingElseWithoutPhotons) {
    const Device device({"", true});
    const Scene scene = two_walls();
    const PhotonMap dark = no_photons();
    Resident resident(device, scene, dark);
    resident.set_light_factors(std::vector<float>{0.5f});
    Renderer renderer(device, resident, 64, 48);
    const Image image = renderer.render(scene.cameras[0], {{}, 0.0f, 4, 2}).image;
    EXPECT_NEAR(image.find("R")->values[64 * 24 + 10], 1.5f, 1e-5f);
    EXPECT_NEAR(image.find("B")->values[64 * 24 + 10], 0.5f, 1e-5f);
    EXPECT_EQ(image.find("R")->values[64 * 24 + 50], 0.0f);
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(Renderer, GathersAnEvenFieldOfPhotonsAsItsIlluminance) {
    const Device device({"", true});
    for (uint mode : {0u, 1u}) {
        const Rendering picture = picture_of(device, two_walls(), even_photons(), {{mode, 50}, {}, 1, 1});
        const size_t pixel = 64 * 24 + 38;
        EXPECT_NEAR(picture.image.find("illuminance")->values[pixel], 0.2126f * 3 + 0.7152f * 2 + 0.0722f, 0.15f)
            << mode;
        EXPECT_NEAR(picture.image.find("R")->values[pixel], 3 * 0.5f / lw_pi, 0.05f) << mode;
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(Renderer, LightsBlackSurfacesByMeshesInEveryMode) {
    Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/cornell.gltf");
    for (Material& m : scene.materials) m.base_color = vec3(0), m.specular = 0, m.metallic = 0;
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000});
    ASSERT_TRUE(photons.records.empty());
    const PhotonMap map = build_photon_map(scene, caster, photons, {.photons = 1000});
    const Device device({"", true});
    const Bvh bvh = build_bvh(scene);
    const Resident resident(device, scene, map, bvh);
    Renderer renderer(device, resident, 24, 24);
    std::vector<double> lux;
    for (uint mode : {gather_mode_cached, gather_mode_smooth}) {
        RenderSettings settings;
        settings.gather.mode = mode;
        double sum = 0;
        const Rendering rendering = renderer.render(scene.cameras[0], settings);
        for (float e : rendering.image.find("illuminance")->values) sum += double(e);
        lux.push_back(sum);
    }
    EXPECT_GT(lux[1], 1);
    EXPECT_NEAR(lux[0] / lux[1], 1, 1e-3);
}

TEST(Renderer, MakesTheSamePictureFromSplitPhotonArrays) {
    const Device device({"", true});
    const RenderSettings settings{{0, 50}, {}, 1, 1};
    const Rendering whole = picture_of(device, two_walls(), even_photons(), settings);
    const Rendering split = picture_of(device, two_walls(), even_photons(), settings, {16384});  // 3 chunks
    for (const Channel& channel : whole.image.channels)
        EXPECT_EQ(channel.values, split.image.find(channel.name)->values);
    EXPECT_THROW(picture_of(device, two_walls(), even_photons(), settings, {8192}), Error);
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

}  // namespace lw
