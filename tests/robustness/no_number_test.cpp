// Light that is no number, because it is beyond all floats: no program writes or prints it. And maps and cameras for
// which numbers are hard to find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "fuzz/feed.h"
#include "gather/renderer.h"
#include "image/light_check.h"
#include "maps/build.h"
#include "maps/estimate.h"
#include "programs/command.h"
#include "programs/lavapipe.h"
#include "robustness/room.h"
#include "scene/gltf_text.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"
#include "trace/reference.h"

namespace lw::test {
namespace {

/// data/cube.gltf with a lamp as bright as any may be, a map whose scales make more of it, a walk and a sensor.
struct Blinding {
    explicit Blinding(const TempFolder& folder) : scene(folder / "cube.gltf"), map(folder / "cube.pmap") {
        std::string text = read_text(LUMENWALK_SOURCE_DIR "/data/cube.gltf");
        const std::string intensity = "\"intensity\": 100";
        write_text(scene, text.replace(text.find(intensity), intensity.size(), "\"intensity\": 3e14"));
        write_text(folder / "cube.ambiances.json", R"({"ambiances": {"all": {"lamp": 1e6}}})");
        write_text(folder / "path.json", R"({"fps": 1, "keys": [{"time": 0, "position": [0, 0, 0.8]}]})");
        write_text(folder / "points.csv", "desk,0.5,-1,0.5\n");
        EXPECT_EQ(run("bake", {scene, "--photons", "2000"}).exit_code, 0);
        std::string bytes = read_text(map);
        const float min_scale = 0x1p-100f;  // light is divided by it
        for (size_t scale_at : {64, 72}) std::memcpy(bytes.data() + scale_at, &min_scale, sizeof min_scale);
        sign_map(bytes);
        write_text(map, bytes);
    }
    std::string scene, map;
};

void expect_refusal(const Outcome& outcome, const char* told) {
    EXPECT_EQ(outcome.exit_code, 1) << told << ": " << outcome.err << outcome.out;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
}

TEST(NoNumber, IsWrittenOrPrintedByNoProgram) {
    const TempFolder folder;
    const Blinding light(folder);
    const std::vector<std::string> before = folder.names();
    expect_refusal(run("measure", {light.scene, "--points", folder / "points.csv", "--csv", folder / "a.csv"}),
                   "which is no light");
    if (!has_lavapipe()) return;
    expect_refusal(run("screenshot", {light.scene, "-o", folder / "a.png", "--size", "8x8", "--samples", "1",
                                      "--ambiance", "all", "--device", "llvmpipe"}),
                   "the picture is not written: ");
    EXPECT_EQ(folder.names(), before);
    expect_refusal(run("", {light.scene, "--play", folder / "path.json", "--frames", folder / "frames", "--size",
                            "16x16", "--ambiance", "all", "--device", "llvmpipe"}),
                   "the picture is not written: ");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "frames"));
}

/// A room smaller than an atom, where squares of distances are nothing.
TEST(NoNumber, IsWrittenByNoPathTracer) {
    const TempFolder folder;
    Room room = plain_room();
    room.node = glm::scale(glm::dmat4(1), glm::dvec3(1e-10));
    room.znear = 1e-12;
    room.candela = 3e14;
    expect_refusal(run("reference", {load(room).path, "-o", folder / "a.exr", "--size", "8x8", "--samples", "2",
                                     "--power", "lamp=1e12"}),
                   "the picture is not written: ");
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(NoNumber, IsInNoPictureOfTheReferenceWhateverTheCamera) {
    const Room room = plain_room();
    const Scene scene = load(room);
    const RayCaster caster(scene);
    const std::vector<vec3> weights = lamp_powers(scene, {});
    ReferenceSettings settings;
    settings.width = 8, settings.height = 6, settings.samples = 4;
    for (float degrees : {1.0f, 60.0f, 170.0f})
        for (const vec3 moved_by : {vec3(0), vec3(0, 2, 0), vec3(0, -1.6f, 0), vec3(0.8f, 0, 0), vec3(50, 0, 0)}) {
            Camera camera = scene.cameras[0];
            camera.yfov = glm::radians(degrees);
            camera.position += moved_by;  // inside the ceiling, on the floor, on a wall, outside
            const Image image = render_reference(scene, caster, camera, weights, settings).image;
            for (const Channel& channel : image.channels)
                for (float v : channel.values) ASSERT_TRUE(std::isfinite(v)) << channel.name << " " << degrees;
            EXPECT_NO_THROW(check_is_light(image)) << degrees;
        }
}

TEST(NoNumber, IsReadWhereAllPhotonsLieInOnePoint) {
    Baked baked(plain_room(), 1'000);
    const SurfaceReader surface(baked.scene);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const std::vector<Photon> all = baked.photons.records;
    for (const uint triangle : {0u, 1u, 2u, 3u}) {  // of some the point is read at a distance of exactly 0
        const auto photon =
            std::find_if(all.begin(), all.end(), [&](const Photon& p) { return p.triangle == triangle; });
        ASSERT_NE(photon, all.end());
        baked.photons.records.assign(500, *photon);
        for (Photon& p : baked.photons.records) p.position = surface.corner_position(triangle, 0);
        const PhotonMap map =
            build_photon_map(baked.scene, baked.caster, baked.photons, {.photons = 501, .radius = 0.1f});
        for (const uint mode : {gather_mode_exact, gather_mode_smooth, gather_mode_cached}) {
            const PhotonEstimator estimator(baked.scene, map, weights, {mode, 50, 0});
            const Gathered light = estimator.estimate(triangle, vec2(0), photon->from);
            EXPECT_GT(light.irradiance.y, 0) << "triangle " << triangle << ", mode " << mode;
            EXPECT_TRUE(std::isfinite(light.irradiance.y)) << "triangle " << triangle << ", mode " << mode;
            EXPECT_TRUE(std::isfinite(light.radiance.y)) << "triangle " << triangle << ", mode " << mode;
            EXPECT_TRUE(light.radius > 0 || mode == gather_mode_cached) << "triangle " << triangle << ", mode " << mode;
        }
    }
}

/// Of a map without any photon and one of photons in one point.
TEST(NoNumber, IsInNoPictureOfAMapOfHardlyAPhoton) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    Baked baked(plain_room(), 1'000);
    const Bvh bvh = build_bvh(baked.scene);
    ASSERT_FALSE(baked.photons.records.empty());
    const Photon one = baked.photons.records[0];
    for (const auto& [count, mode] : {std::pair<size_t, uint>(0, gather_mode_cached), {5'000, gather_mode_exact}}) {
        baked.photons.records.assign(count, one);
        const PhotonMap map =
            build_photon_map(baked.scene, baked.caster, baked.photons, {.photons = count + 1, .radius = 0.1f});
        ASSERT_EQ(map.stored_photons, count);
        const Resident resident(device, baked.scene, map, bvh);
        Renderer renderer(device, resident, 12, 9);
        RenderSettings settings;
        settings.gather.mode = mode;
        settings.gather.neighbours = 50;
        settings.gather.shadow_rays = 0;
        const Image image = renderer.render(baked.scene.cameras[0], settings).image;
        EXPECT_NO_THROW(check_is_light(image)) << count << " photons";
        EXPECT_TRUE(count > 0 || image.find("illuminance")->values[54] > 0) << "the light of the lamp itself";
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lw::test
