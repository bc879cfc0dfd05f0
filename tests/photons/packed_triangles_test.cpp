#include "photons/packed_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf.h"
#include "scene/surface.h"

namespace lw {
namespace {

Scene scene_in_data(const std::string& name) { return load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name); }

const std::vector<vec2> places{{0.2f, 0.3f}, {0.01f, 0.01f}, {0.98f, 0.01f}, {0.01f, 0.98f}};

TEST(PackedTriangles, SayWhatTheSurfaceIsWhereItIsMatte) {
    for (const char* name : {"cornell.gltf", "sphere.gltf"}) {
        const Scene scene = scene_in_data(name);
        const SurfaceReader surfaces(scene);
        const std::vector<PackedTriangle> packed = pack_triangles(scene);
        ASSERT_EQ(packed.size(), scene.triangles.size());
        for (uint t = 0; t < packed.size(); ++t) {
            const Surface s = surfaces.surface_at(t, places[0]);
            ASSERT_TRUE(packed[t].is_matte) << name << " " << t;
            EXPECT_EQ(packed[t].normal, s.geometric_normal) << name << " " << t;
            EXPECT_EQ(packed[t].base_color, s.base_color) << name << " " << t;
            EXPECT_EQ(packed[t].corners[1], scene.positions[scene.triangles[t].y]) << name << " " << t;
        }
    }
}

TEST(PackedTriangles, AreFlatWhereTheShadingNormalIsTheGeometricOne) {
    const Scene box = scene_in_data("cornell.gltf"), sphere = scene_in_data("sphere.gltf");
    for (const PackedTriangle& triangle : pack_triangles(box)) EXPECT_TRUE(triangle.is_flat);
    for (const Scene* scene : {&box, &sphere}) {
        const SurfaceReader surfaces(*scene);
        const std::vector<PackedTriangle> packed = pack_triangles(*scene);
        for (uint t = 0; t < packed.size(); ++t)
            for (vec2 place : places) {
                const Surface s = surfaces.surface_at(t, place);
                EXPECT_TRUE(!packed[t].is_flat || dot(s.normal, s.geometric_normal) > 0.999999f) << t;
            }
    }
    for (const PackedTriangle& triangle : pack_triangles(sphere)) EXPECT_FALSE(triangle.is_flat);
}

TEST(PackedTriangles, OfGlossTexturesAndGlassAreNotMatte) {
    for (const char* name : {"glossy_floor.gltf", "glass_sphere.gltf"}) {
        const std::vector<PackedTriangle> packed = pack_triangles(scene_in_data(name));
        EXPECT_TRUE(std::any_of(packed.begin(), packed.end(), [](const PackedTriangle& f) { return !f.is_matte; }))
            << name;
    }
    Scene tinted = scene_in_data("cornell.gltf");
    tinted.colors.resize(tinted.positions.size(), vec4(0.5f));
    for (const PackedTriangle& triangle : pack_triangles(tinted)) EXPECT_FALSE(triangle.is_matte);
}

}  // namespace
}  // namespace lw
