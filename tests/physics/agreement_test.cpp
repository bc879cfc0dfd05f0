// One scene, three estimators: the gather shader equals the CPU estimate on the same map pixel by pixel, and both agree
// with the path tracer where kernels do not cross a border. Validation messages fail the test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gather/renderer.h"
#include "gather/resident.h"
#include "maps/bake.h"
#include "maps/estimate.h"
#include "scene/gltf.h"
#include "scene/profile.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"
#include "trace/reference.h"

namespace lw {
namespace {

struct Baked {
    Baked(const std::string& name, uint64_t count, const std::vector<std::string>& photometry = {})
        : scene(with_photometry(load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name), photometry)),
          caster(scene),
          map(bake(scene, caster, {.photons = count})),
          bvh(build_bvh(scene)) {}
    Scene scene;
    RayCaster caster;
    PhotonMap map;
    Bvh bvh;
};

void expect_no_messages(const Device& device) {
    for (const std::string& message : device.validation_messages()) ADD_FAILURE() << message;
}

/// Compares every pixel of the shader with the CPU estimate at what the pixel saw, emission left out.
void expect_same(const Baked& baked, uint mode, uint width, uint height) {
    const Device device(DeviceSettings{"", true});
    const Resident resident(device, baked.scene, baked.map, baked.bvh);
    Renderer renderer(device, resident, width, height);
    RenderSettings settings;
    settings.gather = {mode, 50};
    const Camera& camera = baked.scene.cameras[0];
    const Rendering got = renderer.render(camera, settings);
    const std::vector<VisibleSample> seen = renderer.visible_samples();
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const PhotonEstimator estimator(baked.scene, baked.map, weights, settings.gather, baked.bvh);
    const std::vector<float>& lux = got.image.find("illuminance")->values;
    const std::vector<float>& green = got.image.find("G")->values;
    size_t compared = 0, different = 0;
    for (size_t i = 0; i < seen.size(); ++i) {
        if (seen[i].triangle == ~0u) continue;
        const Surface s = estimator.surface_at(seen[i].triangle, seen[i].barycentrics);
        if (s.light >= 0) continue;
        const Gathered expected = estimator.estimate(
            seen[i].triangle, seen[i].barycentrics, normalize(camera.position - s.position),
            estimator.hash_uint(uint(i) + estimator.hash_uint(0)), uvec2(uint(i) % width, uint(i) / width));
        const double e = luminance(expected.irradiance);
        ++compared;
        // A photon exactly at the kernel's rim may fall on either side in float arithmetic of another order.
        if (std::abs(double(lux[i]) - e) > 1e-4 * e + 1e-3)
            ++different;
        else if (std::abs(double(green[i] - expected.radiance.y)) > 1e-3 * double(expected.radiance.y) + 1e-3)
            ++different;
    }
    EXPECT_GT(compared, seen.size() / 2);
    EXPECT_LE(double(different), 0.005 * double(compared)) << "of " << compared << " pixels, mode " << mode;
    expect_no_messages(device);
}

TEST(Agreement, ShaderEqualsCpuEstimateInTheCornellBox) {
    const Baked baked("cornell.gltf", 100000);
    expect_same(baked, 0, 64, 64);
    expect_same(baked, 1, 64, 64);
    expect_same(baked, 2, 64, 64);
}

/// Views at rest go on with the points on lamps where the last one ended: sixteen views of four rays err like one view
/// of 64, where independent ones would err half as much again.
TEST(Agreement, ViewsAtRestCompleteEachOther) {
    const Baked baked("cornell.gltf", 20000);
    const Device device(DeviceSettings{"", true});
    const Resident resident(device, baked.scene, baked.map, baked.bvh);
    const auto lux = [&](uint views, uint rays) {
        RenderSettings settings;
        settings.gather = {gather_mode_smooth, 50, rays};
        settings.samples = views;
        Renderer renderer(device, resident, 48, 48);
        return renderer.render(baked.scene.cameras[0], settings).image.find("illuminance")->values;
    };
    /// Median error of pixels that need rays, against the same views with far more.
    const auto error = [&](uint views, uint rays) {
        const std::vector<float> few = lux(views, rays), many = lux(views, 512 / views);
        std::vector<float> errors;
        for (size_t i = 0; i < few.size(); ++i)
            if (few[i] != many[i]) errors.push_back(std::abs(few[i] - many[i]) / many[i]);
        EXPECT_GT(errors.size(), few.size() / 20);
        std::nth_element(errors.begin(), errors.begin() + long(errors.size() / 2), errors.end());
        return errors[errors.size() / 2];
    };
    EXPECT_LT(error(16, 4), 1.25f * error(1, 64));
    expect_no_messages(device);
}

TEST(Agreement, ShaderEqualsCpuEstimateUnderAPhotometricFile) {
    const Baked baked("cube.gltf", 50000, {"lamp=" LUMENWALK_SOURCE_DIR "/data/photometry/batwing.ies"});
    expect_same(baked, 2, 64, 64);
}

TEST(Agreement, ShaderEqualsCpuEstimateInTheFurnishedRoom) {
    const Baked baked("apartment.glb", 200000);
    expect_same(baked, 0, 96, 54);
    expect_same(baked, 1, 96, 54);
    expect_same(baked, 2, 96, 54);
}

TEST(Agreement, ShaderEqualsCpuEstimateOfCaustics) {
    const Baked baked("glass_sphere.gltf", 200000);
    ASSERT_GT(baked.map.caustic_grids, 0u);
    expect_same(baked, 1, 64, 48);
    expect_same(baked, 2, 64, 48);
}

/// True when the pixels around (x, y) lie on one plane, so that no kernel there crosses a border.
bool is_interior(const Image& image, int x, int y, int reach) {
    const auto& nx = image.find("normal.X")->values;
    const auto& nz = image.find("normal.Z")->values;
    const auto& depth = image.find("depth")->values;
    const size_t centre = size_t(y * image.width + x);
    for (int dy = -reach; dy <= reach; dy += reach)
        for (int dx = -reach; dx <= reach; dx += reach) {
            const int px = x + dx, py = y + dy;
            if (px < 0 || py < 0 || px >= image.width || py >= image.height) return false;
            const size_t i = size_t(py * image.width + px);
            if (std::abs(nx[i] - nx[centre]) + std::abs(nz[i] - nz[centre]) > 0.01f ||
                std::abs(depth[i] - depth[centre]) > 0.5f)
                return false;
        }
    return depth[centre] > 0;
}

TEST(Agreement, MapOfTheCornellBoxHasTheMeanOfThePathTracer) {
    const Baked baked("cornell.gltf", 1000000);
    const Device device(DeviceSettings{"", true});
    const Resident resident(device, baked.scene, baked.map, baked.bvh);
    Renderer renderer(device, resident, 96, 96);
    const Camera& camera = baked.scene.cameras[0];
    const Image got = renderer.render(camera, {}).image;
    ReferenceSettings settings;
    settings.width = settings.height = 96;
    settings.samples = 64;
    const Image truth =
        render_reference(baked.scene, baked.caster, camera, lamp_powers(baked.scene, {}), settings).image;
    double map_sum = 0, truth_sum = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            if (is_interior(got, x, y, 8)) {
                map_sum += double(got.find("illuminance")->values[size_t(y * 96 + x)]);
                truth_sum += double(truth.find("illuminance")->values[size_t(y * 96 + x)]);
            }
    ASSERT_GT(truth_sum, 0);
    EXPECT_NEAR(map_sum / truth_sum, 1, 0.01);
    expect_no_messages(device);
}

TEST(Agreement, DoubledLampDoublesThePicture) {
    const Baked baked("cornell.gltf", 50000);
    const Device device(DeviceSettings{"", true});
    Resident resident(device, baked.scene, baked.map, baked.bvh);
    Renderer renderer(device, resident, 48, 48);
    const Image once = renderer.render(baked.scene.cameras[0], {}).image;
    resident.set_lamp_factors(std::vector<float>{2});
    const Image twice = renderer.render(baked.scene.cameras[0], {}).image;
    for (size_t i = 0; i < once.pixel_count(); ++i)
        EXPECT_NEAR(twice.find("R")->values[i], 2 * once.find("R")->values[i],
                    1e-4f * twice.find("R")->values[i] + 1e-5f);
}

}  // namespace
}  // namespace lw
