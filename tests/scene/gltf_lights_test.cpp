#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

GltfText emissive() {
    GltfText g = square();
    g.doc["materials"] = {{{"emissiveFactor", {1, 0.5, 0.25}},
                           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 100}}}}}}};
    g.primitive()["material"] = 0;
    return g;
}

}  // namespace

TEST(GltfLights, SpotPointsAlongMinusZWhateverItsScale) {
    GltfText g = square();
    g.doc["extensions"]["KHR_lights_punctual"]["lights"][0] = Json::parse(
        R"({"type": "spot", "intensity": 7, "color": [1, 0.5, 0], "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}})");
    g.doc["nodes"][1]["scale"] = {3, 3, 3};
    g.doc["nodes"][1]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    const Light light = g.load().lights[0];
    EXPECT_EQ(light.type, light_spot);
    EXPECT_EQ(light.intensity, vec3(7, 3.5f, 0));
    EXPECT_NEAR(light.direction.y, -1, 1e-6);
    EXPECT_NEAR(light.cos_inner, std::cos(0.1), 1e-6);
    EXPECT_NEAR(light.cos_outer, std::cos(0.5), 1e-6);
}

TEST(GltfLights, NamesAreUnique) {
    GltfText g = square();
    for (const char* name : {"bulb", "bulb_2", "bulb"}) {
        g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size());
        g.doc["nodes"].push_back({{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    }
    const std::vector<std::string> names = g.load().light_names;
    EXPECT_EQ(names.size(), 4u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 4u);
    EXPECT_EQ(names[0], "bulb");
    EXPECT_EQ(names[2], "bulb_2");
}

TEST(GltfLights, ALampOfNoPowerIsKept) {
    GltfText g = square();
    g.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 0;
    EXPECT_EQ(g.load().lights.size(), 1u);
}

TEST(GltfLights, AnEmissiveNodeIsOneLamp) {
    GltfText g = emissive();
    g.doc["meshes"][0]["primitives"].push_back(g.primitive());
    g.node()["scale"] = {2, 2, 2};
    const Scene s = g.load();
    ASSERT_EQ(s.lights.size(), 2u);
    const Light& lamp = s.lights[1];
    EXPECT_EQ(lamp.type, light_mesh);
    EXPECT_EQ(lamp.intensity, vec3(100, 50, 25));
    EXPECT_EQ(lamp.emitter_count, 4u);
    EXPECT_NEAR(lamp.area, 8, 1e-5);
    EXPECT_EQ(s.objects[0].light, 1);
    EXPECT_EQ(s.objects[1].light, 1);
    EXPECT_EQ(s.light_names[1], "thing");
}

TEST(GltfLights, DoubleSidedEmittersCountBothSides) {
    GltfText g = emissive();
    g.doc["materials"][0]["doubleSided"] = true;
    EXPECT_NEAR(g.load().lights[1].area, 2, 1e-6);
}

TEST(GltfHash, IgnoresStrengthsAndCamerasButNotPlaces) {
    const uint64_t before = emissive().load().content_hash;
    GltfText dimmed = emissive();
    dimmed.doc["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 37;
    dimmed.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 1;
    EXPECT_EQ(dimmed.load().content_hash, before);
    GltfText moved = emissive();
    moved.doc["nodes"][1]["translation"] = {0, 0, 2};
    EXPECT_NE(moved.load().content_hash, before);
    GltfText painted = emissive();
    painted.doc["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.5;
    EXPECT_NE(painted.load().content_hash, before);
}

TEST(GltfCameras, OneIsMadeUpInsideTheBounds) {
    GltfText g = square();
    g.floats("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}, "VEC3");
    const Scene s = g.load();
    ASSERT_EQ(s.cameras.size(), 1u);
    for (int c = 0; c < 3; ++c) {
        EXPECT_GE(s.cameras[0].position[c], s.bounds[0][c]);
        EXPECT_LE(s.cameras[0].position[c], s.bounds[1][c]);
    }
}

TEST(GltfCameras, OneThatIsMadeUpSeesAFlatScene) {
    for (const std::vector<float>& corners : {std::vector<float>{0, 0, 0, 3, 0, 0, 3, 2, 0, 0, 2, 0},
                                              std::vector<float>{0, 0, 0, 0, 0, 3, 2, 0, 3, 2, 0, 0},
                                              std::vector<float>{0, 0, 0, 0, 3, 0, 0, 3, 2, 0, 0, 2}}) {
        GltfText g = square();
        g.floats("POSITION", corners, "VEC3");
        const Scene s = g.load();
        const Camera& camera = s.cameras.at(0);
        const vec3 normal = edge_product(s.positions[0], s.positions[1], s.positions[2]);
        EXPECT_GT(std::abs(dot(normalize(normal), normalize(camera.position))), 0.5f) << "seen edge-on";
        for (vec3 corner : s.positions) {
            const vec3 seen = transpose(camera.rotation) * (corner - camera.position);
            EXPECT_LT(seen.z, -camera.near);
            EXPECT_LT(std::abs(seen.y / seen.z), std::tan(0.5f * camera.yfov));
        }
    }
}

TEST(GltfScenes, Apartment) {
    const Scene s = load_gltf(LUMENWALK_SOURCE_DIR "/data/apartment.glb");
    EXPECT_EQ(s.triangles.size(), 443402u);
    EXPECT_EQ(s.lights.size(), 9u);
    ASSERT_EQ(s.cameras.size(), 3u);
    EXPECT_EQ(s.cameras[0].name, "living");
    EXPECT_EQ(s.cameras[1].name, "kitchen");
    EXPECT_EQ(s.cameras[2].name, "corridor");
    EXPECT_EQ(s.textures.size(), 2u);
    EXPECT_TRUE(s.warnings.empty()) << s.warnings[0];
    for (const char* name : {"panel_living_1", "panel_living_2", "panel_kitchen", "panel_corridor", "spot_painting",
                             "spot_counter", "lamp_shelf", "lamp_stool", "sun"})
        EXPECT_EQ(std::count(s.light_names.begin(), s.light_names.end(), name), 1) << name;
    for (vec3 n : s.normals) ASSERT_NEAR(length(n), 1, 1e-5);
}

TEST(GltfScenes, OurScenesFaceInwards) {
    for (const char* name : {"sphere", "furnace", "cube"}) {
        const Scene s = load_gltf(std::string(LUMENWALK_SOURCE_DIR "/data/") + name + ".gltf");
        for (size_t t = 0; t < s.triangles.size(); ++t) {
            const vec3 corner = s.positions[s.triangles[t].x];
            ASSERT_LT(dot(front_of(s, t), corner), 0) << name;
            ASSERT_GT(dot(front_of(s, t), s.normals[s.triangles[t].x]), 0.9f) << name;
        }
        EXPECT_EQ(s.lights.size(), 1u);
        EXPECT_TRUE(s.warnings.empty()) << s.warnings[0];
    }
    const Scene cornell = load_gltf(LUMENWALK_SOURCE_DIR "/data/cornell.gltf");
    EXPECT_EQ(cornell.light_names[0], "ceiling_lamp");
    EXPECT_EQ(cornell.lights[0].direction, vec3(0, -1, 0));
    EXPECT_EQ(cornell.cameras[0].name, "front");
}

}  // namespace lw::test
