#include "photons/facets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf.h"
#include "scene/surface.h"

namespace lw {
namespace {

Scene scene_in_data(const std::string& name) { return load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name); }

const std::vector<vec2> places{{0.2f, 0.3f}, {0.01f, 0.01f}, {0.98f, 0.01f}, {0.01f, 0.98f}};

TEST(Facets, SayWhatTheSurfaceIsWhereItIsMatte) {
    for (const char* name : {"cornell.gltf", "sphere.gltf"}) {
        const Scene scene = scene_in_data(name);
        const SurfaceReader surfaces(scene);
        const std::vector<Facet> facets = facets_of(scene);
        ASSERT_EQ(facets.size(), scene.triangles.size());
        for (uint t = 0; t < facets.size(); ++t) {
            const Surface s = surfaces.surface_at(t, places[0]);
            ASSERT_TRUE(facets[t].is_matte) << name << " " << t;
            EXPECT_EQ(facets[t].normal, s.geometric_normal) << name << " " << t;
            EXPECT_EQ(facets[t].base_color, s.base_color) << name << " " << t;
            EXPECT_EQ(facets[t].corners[1], scene.positions[scene.triangles[t].y]) << name << " " << t;
        }
    }
}

TEST(Facets, AreFlatWhereTheShadingNormalIsTheGeometricOne) {
    const Scene box = scene_in_data("cornell.gltf"), sphere = scene_in_data("sphere.gltf");
    for (const Facet& facet : facets_of(box)) EXPECT_TRUE(facet.is_flat);
    for (const Scene* scene : {&box, &sphere}) {
        const SurfaceReader surfaces(*scene);
        const std::vector<Facet> facets = facets_of(*scene);
        for (uint t = 0; t < facets.size(); ++t)
            for (vec2 place : places) {
                const Surface s = surfaces.surface_at(t, place);
                EXPECT_TRUE(!facets[t].is_flat || dot(s.normal, s.geometric_normal) > 0.999999f) << t;
            }
    }
    for (const Facet& facet : facets_of(sphere)) EXPECT_FALSE(facet.is_flat);
}

TEST(Facets, OfGlossTexturesAndGlassAreNotMatte) {
    for (const char* name : {"glossy_floor.gltf", "glass_sphere.gltf"}) {
        const std::vector<Facet> facets = facets_of(scene_in_data(name));
        EXPECT_TRUE(std::any_of(facets.begin(), facets.end(), [](const Facet& f) { return !f.is_matte; })) << name;
    }
    Scene tinted = scene_in_data("cornell.gltf");
    tinted.colors.resize(tinted.positions.size(), vec4(0.5f));
    for (const Facet& facet : facets_of(tinted)) EXPECT_FALSE(facet.is_matte);
}

}  // namespace
}  // namespace lw
