// What a view shows of gloss, mirrors, glass and blends: by the text of the gather shader on the CPU and by the shader
// itself, against the path tracer and against furnaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "gather/renderer.h"
#include "maps/bake.h"
#include "maps/estimate.h"
#include "scene/gltf.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"
#include "trace/reference.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

Material& material_named(Scene& scene, const std::string& name) {
    for (size_t i = 0; i < scene.material_names.size(); ++i)
        if (scene.material_names[i] == name) return scene.materials[i];
    ADD_FAILURE() << "no material " << name;
    return scene.materials[0];
}

struct Room {
    Room(const std::string& file, const std::function<void(Scene&)>& change, uint64_t photons)
        : scene(changed(file, change)),
          caster(scene),
          weights(light_powers(scene, {})),
          map(bake(scene, caster, {.photons = photons})),
          bvh(build_bvh(scene)) {}
    static Scene changed(const std::string& file, const std::function<void(Scene&)>& change) {
        Scene scene = load_gltf(file_in_data(file));
        if (change) change(scene);
        return scene;
    }
    Scene scene;
    RayCaster caster;
    std::vector<vec3> weights;
    PhotonMap map;
    Bvh bvh;
};

constexpr uint width = 64, height = 48;

/// Mean luminance of what pixels that see a material show, in the default modes and in the reference.
void expect_agreement(const Room& room, const std::vector<std::string>& materials, double tolerance,
                      uint64_t samples = 64, uint paths = 16) {
    ReferenceSettings reference;
    reference.width = width, reference.height = height, reference.samples = samples;
    reference.illuminance = false;
    const Image truth = render_reference(room.scene, room.caster, room.scene.cameras[0], room.weights, reference).image;
    const Device device(DeviceSettings{"", true});
    const Resident resident(device, room.scene, room.map, room.bvh);
    Renderer renderer(device, resident, width, height);
    for (uint mode : {gather_mode_cached, gather_mode_smooth}) {
        RenderSettings settings;
        settings.gather.mode = mode;
        settings.gather.paths = paths;
        const Image got = renderer.render(room.scene.cameras[0], settings).image;
        for (const std::string& material : materials) {
            double picture = 0, wanted = 0, error2 = 0;
            size_t count = 0;
            for (size_t i = 0; i < got.pixel_count(); ++i) {
                const float triangle = truth.find("triangle")->values[i];
                if (triangle < 0) continue;
                const Object& object = room.scene.objects[room.scene.triangle_objects[size_t(triangle)]];
                if (room.scene.material_names[object.material] != material) continue;
                ++count;
                picture += double(got.find("G")->values[i]);
                wanted += double(truth.find("G")->values[i]);
                error2 += std::pow(double(truth.find("error.G")->values[i]), 2);
                EXPECT_TRUE(std::isfinite(got.find("G")->values[i])) << i;
            }
            EXPECT_GT(count, 30u);
            const double error = std::sqrt(error2) / wanted;
            EXPECT_LT(error, 0.05);
            EXPECT_NEAR(picture / wanted, 1, tolerance + 3 * error)
                << room.scene.path << ", " << material << ", mode " << mode;
        }
    }
    for (const std::string& message : device.validation_messages()) ADD_FAILURE() << message;
}

TEST(Gloss, APolishedFloorShowsWhatThePathTracerShowsAtEveryRoughness) {
    for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f})
        expect_agreement(Room(
                             "glossy_floor.gltf",
                             [&](Scene& scene) { material_named(scene, "polished").roughness = roughness; }, 300000),
                         {"polished"}, 0.01);
}

TEST(Gloss, RoughWallsThatReflectMuchShowWhatThePathTracerShows) {
    const Room room(
        "cornell.gltf",
        [](Scene& scene) {
            Material& white = material_named(scene, "white");
            white.ior = 4, white.roughness = 1, white.specular = 1;
        },
        300000);
    expect_agreement(room, {"white"},
                     0.03);  // the cached mode takes light between walls as coming from all sides alike
}

TEST(Gloss, RoughWallsThatReflectMuchUnderAPointLampToo) {
    const Room room(
        "cube.gltf",
        [](Scene& scene) {
            Material& grey = material_named(scene, "grey");
            grey.base_color = vec3(0.05f);
            grey.ior = 4, grey.roughness = 1, grey.specular = 1;
        },
        300000);
    expect_agreement(room, {"grey"}, 0.02);
}

TEST(Gloss, AMetalRingAndAMirrorBallShowWhatThePathTracerShows) {
    const Room room("metal_sculpture.gltf", nullptr, 300000);
    expect_agreement(room, {"gold", "chrome"}, 0.02);
}

TEST(Gloss, AGlassBallAndATintedSheetShowWhatThePathTracerShows) {
    const Room room("glass_sphere.gltf", nullptr, 300000);
    expect_agreement(room, {"solid", "sheet"}, 0.02);
}

TEST(Gloss, RoughGlassShowsWhatThePathTracerShows) {
    const Room room(
        "glass_sphere.gltf",
        [](Scene& scene) {
            material_named(scene, "solid").roughness = 0.4f;
            material_named(scene, "sheet").roughness = 0.4f;
        },
        300000);
    expect_agreement(room, {"sheet", "solid"}, 0.03, 1024, 64);  // both find by chance only what rough glass throws
}

TEST(Gloss, ABlendedSheetIsLaidOverWhatIsBehind) {
    const Room room(
        "glass_sphere.gltf",
        [](Scene& scene) {
            Material& m = material_named(scene, "sheet");
            m.transmission = 0, m.specular = 0, m.flags |= material_alpha_blend, m.alpha = 0.3f;
        },
        300000);
    expect_agreement(room, {"sheet"}, 0.02);
}

TEST(Gloss, ASceneWithoutItFollowsNothing) {
    const Device device(DeviceSettings{"", true});
    const Room plain("cornell.gltf", nullptr, 1000), polished("glossy_floor.gltf", nullptr, 1000);
    EXPECT_FALSE(Resident(device, plain.scene, plain.map, plain.bvh).may_follow());
    EXPECT_TRUE(Resident(device, polished.scene, polished.map, polished.bvh).may_follow());
}

TEST(Gloss, ALampThatIsHalfThereSendsHalfItsLight) {
    const auto lux_of_floor = [&](float alpha) {
        Scene scene = load_gltf(file_in_data("cornell.gltf"));
        for (Material& m : scene.materials)
            if (m.emissive.y > 0) m.flags |= material_alpha_blend, m.alpha = alpha;
        const std::vector<vec3> weights = light_powers(scene, {});
        PhotonMap dark;
        dark.settings.radius = 0.1f;
        dark.grid_of_side.assign(2 * scene.triangles.size(), no_grid);
        const Bvh bvh = build_bvh(scene);
        const PhotonEstimator estimator(scene, dark, weights, {gather_mode_smooth, 50, 64}, bvh);
        double sum = 0;
        for (uint t = 0; t < scene.triangles.size(); ++t)
            if (estimator.surface_at(t, vec2(0.3f)).geometric_normal.y > 0.9f)
                sum += double(estimator.estimate(t, vec2(0.3f), vec3(0, 1, 0), t).irradiance.y);
        return sum;
    };
    EXPECT_GT(lux_of_floor(1), 1);
    EXPECT_NEAR(lux_of_floor(0.5f) / lux_of_floor(1), 0.5, 1e-3);
}

}  // namespace
}  // namespace lw
