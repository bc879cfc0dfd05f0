// What exporters write beside plain glTF 2.0: other pictures and materials, figures, hidden nodes.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf_text.h"
#include "scene/webp_row.h"

namespace lw::test {
namespace {

bool warns(const Scene& scene, const std::string& words) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TEST(GltfFormats, ABasisTextureOpensWithItsFactorAndSaysHowToConvert) {
    GltfText g = square();
    g.doc["images"] = {{{"uri", "data:image/ktx2;base64,AAAA"}}};
    g.doc["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    g.doc["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
    g.doc["extensionsRequired"] = {"KHR_texture_basisu"};
    g.primitive()["material"] = 0;
    const Scene scene = g.load();
    EXPECT_TRUE(warns(scene, "gltf-transform ktxdecompress"));
    EXPECT_LT(scene.materials[0].base_color_texture.texture, 0);
    EXPECT_FLOAT_EQ(scene.materials[0].base_color.x, 0.5f);
}

TEST(GltfFormats, SpecularGlossinessBecomesADielectricOfThatSpecularColour) {
    GltfText g = square();
    g.doc["materials"] = {{{"extensions",
                            {{"KHR_materials_pbrSpecularGlossiness",
                              {{"diffuseFactor", {0.2, 0.3, 0.4, 1}},
                               {"specularFactor", {0.04, 0.05, 0.06}},
                               {"glossinessFactor", 0.25}}}}}}};
    g.primitive()["material"] = 0;
    const Scene scene = g.load();
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.base_color, vec3(0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_FLOAT_EQ(m.roughness, 0.75f);
    const float r = (m.ior - 1) / (m.ior + 1);
    EXPECT_FLOAT_EQ(m.specular_color.y * r * r * m.specular, 0.05f) << "reflectance at normal incidence";
}

TEST(GltfFormats, GlossinessInATextureBecomesRoughness) {
    const std::vector<unsigned char> bytes = webp_row({255, 255, 255, 51});
    GltfText g = square();
    g.floats("TEXCOORD_0", {0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    g.doc["images"] = {{{"bufferView", g.view(bytes)}, {"mimeType", "image/webp"}}};
    g.doc["textures"] = {{{"source", 0}}};
    g.doc["materials"] = {{{"extensions",
                            {{"KHR_materials_pbrSpecularGlossiness",
                              {{"glossinessFactor", 0.5}, {"specularGlossinessTexture", {{"index", 0}}}}}}}}};
    g.primitive()["material"] = 0;
    const Scene scene = g.load();
    const Material& m = scene.materials[0];
    const Texture& texture = scene.textures[size_t(m.metallic_roughness_texture.texture)];
    const uint texel = scene.texels[texture.first_texel];
    EXPECT_NEAR(m.roughness * float((texel >> 8) & 255u) / 255, 1 - 0.5 * 51 / 255, 0.003);
    EXPECT_TRUE(warns(scene, "replaced by their mean"));
}

TEST(GltfFormats, AHiddenNodeHidesAllBelowIt) {
    GltfText g = square();
    g.doc["nodes"][1]["children"] = {2};
    g.doc["nodes"].push_back({{"name", "below"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    EXPECT_EQ(g.load().lights.size(), 2u);
    g.doc["nodes"][2]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
    EXPECT_EQ(g.load().lights.size(), 1u);
    g.doc["nodes"][1]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
    EXPECT_NE(refusal_of(g).find("has no light"), std::string::npos);
}

TEST(GltfFormats, AMeshStandsInItsDefaultMorphWeights) {
    GltfText g = square();
    g.primitive()["targets"] = {{{"POSITION", g.accessor(std::vector<float>(12, 2.0f), "VEC3", 5126)}}};
    g.doc["meshes"][0]["weights"] = {0.5};
    EXPECT_NEAR(world(g.load(), 0).x, 1, 1e-6) << "the weights of the mesh";
    g.node()["weights"] = {0.25};
    EXPECT_NEAR(world(g.load(), 0).x, 0.5, 1e-6) << "those of the node replace them";
}

TEST(GltfFormats, JointsPlaceASkinnedMeshAndItsNodeDoesNot) {
    GltfText g = square();
    g.attribute("JOINTS_0",
                g.accessor(std::vector<uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", 5121));
    g.floats("WEIGHTS_0", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
    g.node()["skin"] = 0;
    g.node()["translation"] = {100, 0, 0};
    g.doc["nodes"].push_back({{"name", "joint"}, {"translation", {0, 3, 0}}, {"children", {3}}});
    g.doc["nodes"].push_back({{"name", "tip"}, {"translation", {0, 0, 8}}});
    g.doc["scenes"][0]["nodes"].push_back(2);
    g.doc["skins"] = {{{"joints", {2, 3}}}};
    const Scene scene = g.load();
    EXPECT_NEAR(world(scene, 1).x, 1, 1e-6) << "the node's own place does not count";
    EXPECT_NEAR(world(scene, 1).y, 3, 1e-6);
    bool found = false;
    for (size_t i = 0; i < scene.positions.size(); ++i)
        found |= glm::length(world(scene, i) - glm::dvec3(0, 4, 4)) < 1e-5;
    EXPECT_TRUE(found) << "the last corner follows both joints by halves";
    g.doc["skins"][0]["joints"] = {2};
    EXPECT_NE(refusal_of(g).find("names joint 1 of a skin that has 1"), std::string::npos) << refusal_of(g);
}

TEST(GltfFormats, AVariantChoosesItsMaterials) {
    GltfText g = square();
    g.doc["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.1, 0.1, 1}}}}},
                          {{"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.7, 0.7, 1}}}}}};
    g.primitive()["material"] = 0;
    g.doc["extensions"]["KHR_materials_variants"] = {{"variants", {{{"name", "oak"}}, {{"name", "ash"}}}}};
    g.primitive()["extensions"]["KHR_materials_variants"] = {{"mappings", {{{"material", 1}, {"variants", {1}}}}}};
    const auto reflectance = [&](const std::string& variant) {
        return load_gltf(g.save(), {.variant = variant, .strict = false}).material_of(0).base_color.x;
    };
    EXPECT_FLOAT_EQ(reflectance(""), 0.1f);
    EXPECT_FLOAT_EQ(reflectance("oak"), 0.1f);
    EXPECT_FLOAT_EQ(reflectance("ash"), 0.7f);
    EXPECT_THROW(reflectance("elm"), Error);
}

TEST(GltfFormats, ARequiredExtensionOfTheLookOpensWithAWarningUnlessStrict) {
    GltfText g = square();
    g.doc["extensionsRequired"] = {"KHR_materials_clearcoat"};
    EXPECT_TRUE(warns(g.load(), "KHR_materials_clearcoat is ignored"));
    EXPECT_THROW(load_gltf(g.save(), {.variant = "", .strict = true}), Error);
    g.doc["extensionsRequired"] = {"EXT_mesh_something"};
    EXPECT_NE(refusal_of(g).find("requires the extension EXT_mesh_something"), std::string::npos);
}

TEST(GltfFormats, AMaterialThatGlowsBlackIsNoLamp) {
    GltfText g = square();
    g.floats("TEXCOORD_0", {0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    const std::vector<unsigned char> bytes = webp_row({0, 0, 0, 255});
    g.doc["images"] = {{{"bufferView", g.view(bytes)}, {"mimeType", "image/webp"}}};
    g.doc["textures"] = {{{"source", 0}}};
    g.doc["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
    g.primitive()["material"] = 0;
    EXPECT_EQ(g.load().lights.size(), 2u) << "a lamp while it has no texture";
    g.doc["materials"][0]["emissiveTexture"] = {{"index", 0}};
    EXPECT_EQ(g.load().lights.size(), 1u);
}

TEST(GltfFormats, AColourBeyondOneIsTold) {
    GltfText g = square();
    EXPECT_FALSE(warns(g.load(), "larger than 1"));
    g.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["color"] = {255, 255, 255};
    EXPECT_TRUE(warns(g.load(), "from 0 to 255"));
}

TEST(GltfFormats, AUriMayGoDownAndUpInsideTheFolder) {
    GltfText g = square();
    Json file = Json::parse(g.text());
    const auto beside = GltfText::write(std::string(g.bytes.begin(), g.bytes.end()), "plain.bin");
    file["buffers"][0]["uri"] = "sub/../plain.bin";
    EXPECT_EQ(load_gltf(GltfText::write(file.dump(), "up.gltf")).triangles.size(), 2u);
    file["buffers"][0]["uri"] = "sub/../../plain.bin";
    EXPECT_THROW(load_gltf(GltfText::write(file.dump(), "up.gltf")), Error);
}

}  // namespace
}  // namespace lw::test
