// The device's ray queries give the pictures of the traversal in compute. Skipped where no device has them; tools/test
// runs these tests on a newer software rasterizer too (tools/newer-mesa).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "base/error.h"
#include "gather/renderer.h"
#include "maps/bake.h"
#include "scene/gltf.h"
#include "trace/build_bvh.h"

namespace lw {
namespace {

/// Cuts squares of 25 cm out of all surfaces of a material.
void chequer(Scene& scene, Material& material) {
    scene.textures.push_back({uint(scene.texels.size()), 2, 2, wrap_repeat, wrap_repeat, 0, 1});
    scene.texels.insert(scene.texels.end(), {0xffffffffu, 0x00ffffffu, 0x00ffffffu, 0xffffffffu});
    for (const vec3& p : scene.positions) scene.uv0.push_back(2.0f * vec2(p.x + 0.3f * p.y, p.z + 0.7f * p.y));
    material.base_color_texture = {int(scene.textures.size()) - 1, 0, vec3(1, 0, 0), vec3(0, 1, 0)};
    material.flags |= material_alpha_mask;
    material.alpha_cutoff = 0.5f;
}

struct RayQueries : testing::Test {
    void SetUp() override {
        try {
            queries_ = std::make_unique<Device>(settings(Rays::queries));
        } catch (const Error& lack) {
            ASSERT_NE(std::string(lack.what()).find("lacks ray queries (VK_KHR_ray_query)"), std::string::npos)
                << lack.what();
            if (std::getenv("LUMENWALK_NEEDS_RAY_QUERIES")) FAIL() << lack.what();
            GTEST_SKIP() << lack.what();
        }
        compute_ = std::make_unique<Device>(settings(Rays::compute));
        ASSERT_TRUE(queries_->ray_queries());
        ASSERT_FALSE(compute_->ray_queries());
    }
    void TearDown() override {
        if (!queries_) return;
        for (const std::string& message : queries_->validation_messages()) ADD_FAILURE() << message;
    }
    static DeviceSettings settings(Rays rays) { return {.name = "", .validation = true, .rays = rays}; }

    std::unique_ptr<Device> queries_, compute_;
};

struct Pictures {
    Pictures(const std::string& file, uint64_t photons, const std::function<void(Scene&)>& change = nullptr)
        : scene(load_gltf(LUMENWALK_SOURCE_DIR "/data/" + file)) {
        if (change) change(scene);
        const RayCaster caster(scene);
        map = bake(scene, caster, {.photons = photons});
        bvh = build_bvh(scene);
    }
    Image on(const Device& device) const {
        const Resident resident(device, scene, map, bvh);
        EXPECT_EQ(resident.queries_rays(), device.ray_queries());
        RenderSettings settings;
        settings.samples = 2;
        return Renderer(device, resident, 96, 72).render(scene.cameras[0], settings).image;
    }
    Scene scene;
    PhotonMap map;
    Bvh bvh;
};

/// Light of nearly every pixel, and the mean: a ray along an edge may fall on either side of it.
void expect_same(const Image& got, const Image& expected) {
    for (const char* channel : {"G", "illuminance"}) {
        const std::vector<float>&a = got.find(channel)->values, &b = expected.find(channel)->values;
        double sum = 0, difference = 0;
        size_t others = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            sum += double(b[i]), difference += double(a[i]) - double(b[i]);
            others += std::abs(a[i] - b[i]) > 1e-3f * b[i] + 1e-3f;
        }
        EXPECT_GT(sum, 0);
        EXPECT_NEAR(difference / sum, 0, 5e-4) << channel;
        EXPECT_LE(others, a.size() / 200) << channel;
    }
}

TEST_F(RayQueries, GiveTheShadowsOfOpaqueTriangles) {
    const Pictures room("cornell.gltf", 20000);
    expect_same(room.on(*queries_), room.on(*compute_));
}

TEST_F(RayQueries, FollowReflectionsAndGlass) {
    for (const char* file : {"glossy_floor.gltf", "glass_sphere.gltf", "apartment.glb"}) {
        SCOPED_TRACE(file);
        const Pictures room(file, 50000);
        expect_same(room.on(*queries_), room.on(*compute_));
    }
}

TEST_F(RayQueries, PassWhatLetsLightThrough) {
    const Pictures all_through("cornell.gltf", 20000, [](Scene& scene) {  // no opaque triangle at all
        for (Material& m : scene.materials) m.flags |= material_alpha_blend, m.alpha = 0.9f;
    });
    expect_same(all_through.on(*queries_), all_through.on(*compute_));
    const Pictures cut_out("cornell.gltf", 20000, [](Scene& scene) {  // a chequered wall and boxes, half of them holes
        chequer(scene, scene.materials[0]);
    });
    expect_same(cut_out.on(*queries_), cut_out.on(*compute_));
    const Pictures thin_glass("glass_sphere.gltf", 20000, [](Scene& scene) {
        for (Material& m : scene.materials)
            if (m.transmission > 0) m.flags |= material_thin, m.base_color = vec3(0.3f, 0.9f, 0.5f);
    });
    expect_same(thin_glass.on(*queries_), thin_glass.on(*compute_));
}

TEST_F(RayQueries, AreNotTheFastestOnAProcessor) {
    const Device device(settings(Rays::fastest));
    const bool is_processor = device.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    EXPECT_EQ(device.ray_queries(), !is_processor);
}

}  // namespace
}  // namespace lw
