#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf_text.h"
#include "scene/surface.h"

namespace lw::test {
namespace {

// 2 x 2 PNG: red, green / blue, white.
const std::string png_uri =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR4nGP4z8DAAMIM/4EAAB/"
    "uBfsL2WiLAAAAAElFTkSuQmCC";

GltfText textured(const std::string& uri) {
    GltfText g = square();
    g.floats("TEXCOORD_0", {0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    g.doc["images"] = {{{"uri", uri}, {"name", "picture"}}};
    g.doc["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    g.doc["textures"] = {{{"source", 0}, {"sampler", 0}}};
    g.doc["materials"] = {
        {{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}}};
    g.primitive()["material"] = 0;
    return g;
}

void expect_near(vec4 a, vec4 b) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(a[c], b[c], 1e-6f) << c;
}

/// A closed glass tetrahedron, with KHR_materials_volume unless that is empty.
GltfText glass(const Json& volume) {
    GltfText g;
    g.floats("POSITION", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    g.primitive()["indices"] = g.accessor(std::vector<uint8_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, "SCALAR", 5121);
    g.primitive()["material"] = 0;
    g.doc["materials"] = {{{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}}};
    if (!volume.empty()) g.doc["materials"][0]["extensions"]["KHR_materials_volume"] = volume;
    return g;
}

}  // namespace

TEST(GltfMaterials, MissingMaterialIsTheDefault) {
    const Scene s = square().load();
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].base_color, vec3(1));
    EXPECT_EQ(s.materials[0].metallic, 1);
    EXPECT_EQ(s.materials[0].roughness, 1);
    EXPECT_TRUE(s.uv0.empty() && s.uv1.empty() && s.colors.empty() && s.tangents.empty());
}

TEST(GltfMaterials, FactorsAndExtensions) {
    GltfText g = square();
    g.primitive()["material"] = 0;
    g.doc["materials"] =
        Json::parse(R"([{"doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25, "emissiveFactor": [1, 0.5, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 40}, "KHR_materials_ior": {"ior": 1.33},
                       "KHR_materials_specular": {"specularFactor": 0.7, "specularColorFactor": [1, 0.9, 0.8]}}}])");
    const Scene s = g.load();
    const Material& m = s.materials[0];
    EXPECT_EQ(m.base_color, vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.alpha, 0.4f);
    EXPECT_EQ(m.emissive, vec3(40, 20, 0));
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0.7f);
    EXPECT_EQ(m.specular_color, vec3(1, 0.9f, 0.8f));
    EXPECT_EQ(m.alpha_cutoff, 0.25f);
    EXPECT_EQ(m.flags, material_double_sided | material_alpha_mask);
}

TEST(GltfMaterials, GlassIsThinUnlessItHasAThickness) {
    EXPECT_TRUE(glass({}).load().materials[0].flags & material_thin);
    EXPECT_TRUE(glass({{"thicknessFactor", 0}, {"attenuationDistance", 1}}).load().materials[0].flags & material_thin);
    EXPECT_FALSE(glass({{"thicknessFactor", 0.1}}).load().materials[0].flags & material_thin);
}

TEST(GltfMaterials, AbsorptionGivesTheAttenuationColourAtItsDistance) {
    const Json volume = {{"thicknessFactor", 1}, {"attenuationDistance", 0.5}, {"attenuationColor", {0.25, 1, 0}}};
    const vec3 a = glass(volume).load().materials[0].absorption;
    EXPECT_NEAR(std::exp(-a.x * 0.5f), 0.25f, 1e-6f);
    EXPECT_EQ(a.y, 0);
    EXPECT_GT(a.z, 20);
    EXPECT_TRUE(std::isfinite(a.z));
    EXPECT_EQ(glass({{"thicknessFactor", 1}}).load().materials[0].absorption, vec3(0));
    EXPECT_EQ(glass({{"thicknessFactor", 0}, {"attenuationDistance", 0.1}, {"attenuationColor", {0, 0, 0}}})
                  .load()
                  .materials[0]
                  .absorption,
              vec3(0));
}

TEST(GltfMaterials, AVolumeThatMakesNoSenseIsRefused) {
    const auto refusal = [](const Json& volume) { return load_error_of([&] { glass(volume).load(); }); };
    EXPECT_NE(refusal({{"thicknessFactor", 1}, {"attenuationDistance", 0}}).find("attenuationDistance"),
              std::string::npos);
    EXPECT_NE(refusal({{"thicknessFactor", -1}}).find("thicknessFactor"), std::string::npos);
}

TEST(GltfMaterials, VertexColoursAreLinearAndOpaqueByDefault) {
    GltfText g = square();
    g.attribute("COLOR_0",
                g.accessor(std::vector<uint8_t>{51, 0, 255, 51, 0, 255, 51, 0, 255, 51, 0, 255}, "VEC3", 5121, true));
    expect_near(g.load().colors[2], vec4(0.2f, 0, 1, 1));
}

TEST(GltfTextures, TexelsSamplerAndEncoding) {
    const Scene s = textured(png_uri).load();
    ASSERT_EQ(s.textures.size(), 1u);
    const Texture& t = s.textures[0];
    EXPECT_EQ(t.width, 2u);
    EXPECT_EQ(t.wrap_s, wrap_clamp);
    EXPECT_EQ(t.wrap_t, wrap_mirror);
    EXPECT_EQ(t.srgb, 1u);
    EXPECT_EQ(s.texels, (std::vector<uint>{0xff0000ffu, 0xff00ff00u, 0xffff0000u, 0xffffffffu}));
    EXPECT_EQ(s.uv0.size(), 4u);
}

TEST(GltfTextures, TransformIsOffsetTimesRotationTimesScale) {
    GltfText g = textured(png_uri);
    g.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] =
        Json::parse(R"({"offset": [0.1, 0.2], "rotation": 1.5707963267948966, "scale": [2, 3]})");
    const TextureSlot slot = g.load().materials[0].base_color_texture;
    const vec3 row0(0, 3, 0.1f), row1(-2, 0, 0.2f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(slot.row0[c], row0[c], 1e-6f);
        EXPECT_NEAR(slot.row1[c], row1[c], 1e-6f);
    }
}

TEST(GltfTextures, AnImageThatCannotBeDecodedLeavesItsFactor) {
    for (const std::string uri : {"data:image/png;base64,AAAA", "data:image/webp;base64,UklGRg==", "missing.png",
                                  "data:image/png;base64,!!!!####", "data:image/png;base64,", "data:"}) {
        std::string error;
        Scene s;
        error = load_error_of([&] { s = textured(uri).load(); });
        ASSERT_EQ(error, "") << uri;
        EXPECT_EQ(s.materials[0].base_color_texture.texture, -1) << uri;
        ASSERT_EQ(s.warnings.size(), 1u) << uri;
        EXPECT_NE(s.warnings[0].find("picture"), std::string::npos) << s.warnings[0];
    }
}

TEST(GltfTextures, AnImageWithoutAUsableSourceLeavesItsFactor) {
    for (const char* image :
         {R"({"name": "picture"})", R"({"name": "picture", "bufferView": 99})", R"({"name": "picture", "uri": 7})",
          R"({"name": "picture", "uri": "a.png", "bufferView": 0})"}) {
        GltfText g = textured(png_uri);
        g.doc["images"] = Json::array({Json::parse(image)});
        Scene s;
        ASSERT_EQ(load_error_of([&] { s = g.load(); }), "") << image;
        EXPECT_EQ(s.materials[0].base_color_texture.texture, -1) << image;
        ASSERT_EQ(s.warnings.size(), 1u) << image;
        EXPECT_NE(s.warnings[0].find("picture"), std::string::npos) << s.warnings[0];
    }
}

/// What an image says of its size is enough: nothing is decoded.
TEST(GltfTextures, AnImageOfMoreTexelsThanCanBeCountedIsRefused) {
    const std::string header = "P5 100000 100000 255\n";  // a PGM
    const std::string uri = "data:image/png;base64," + base64(std::vector<uint8_t>(header.begin(), header.end()));
    EXPECT_NE(load_error_of([&] {
                  textured(uri).load();
              }).find("image 0 \"picture\": the textures have more than 2^32 texels"),
              std::string::npos);
}

TEST(GltfTextures, BilinearSamplesMeetAtTexelCentres) {
    Scene s = textured(png_uri).load();
    s.textures[0].srgb = 0;
    const SurfaceReader reader(s);
    const TextureSlot slot = s.materials[0].base_color_texture;
    const auto at = [&](float u, float v) { return reader.sample_texture(slot, vec2(u, v), vec2(0)); };
    expect_near(at(0.25f, 0.25f), vec4(1, 0, 0, 1));
    expect_near(at(0.75f, 0.25f), vec4(0, 1, 0, 1));
    expect_near(at(0.5f, 0.25f), vec4(0.5f, 0.5f, 0, 1));
    expect_near(at(0.5f, 0.5f), vec4(0.5f, 0.5f, 0.5f, 1));
    expect_near(at(0.25f, 1.25f), vec4(0, 0, 1, 1));  // mirrored in t
    s.textures[0].nearest = 1;
    expect_near(at(0.49f, 0.1f), vec4(1, 0, 0, 1));
    s.textures[0].nearest = 0;
    s.textures[0].wrap_s = s.textures[0].wrap_t = wrap_repeat;
    expect_near(at(0, 0.25f), vec4(0.5f, 0.5f, 0, 1));  // half way across the seam
    expect_near(at(-0.75f, 3.25f), vec4(1, 0, 0, 1));
}

TEST(GltfTextures, EveryCodeOfATexelIsDecodedAsTheStandardSays) {
    const Scene scene;
    const SurfaceReader reader(scene);
    for (int code = 0; code < 256; ++code) {
        const double c = code / 255.0, linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(reader.srgb_to_linear(float(c)), linear, 6e-5 * linear) << code;
    }
    EXPECT_FLOAT_EQ(reader.srgb_to_linear(1), 1);
}

TEST(GltfTextures, ClampReachesTheBorderTexelOutsideTheUnitSquare) {
    Scene s = textured(png_uri).load();
    s.textures[0].srgb = 0;
    s.textures[0].wrap_t = wrap_clamp;
    const SurfaceReader reader(s);
    const TextureSlot slot = s.materials[0].base_color_texture;
    expect_near(reader.sample_texture(slot, vec2(-0.5f, -0.5f), vec2(0)), vec4(1, 0, 0, 1));
    expect_near(reader.sample_texture(slot, vec2(1.5f, -7), vec2(0)), vec4(0, 1, 0, 1));
}

TEST(GltfTextures, TangentsAreMadeForANormalMap) {
    GltfText g = textured(png_uri);
    g.doc["materials"][0]["normalTexture"]["index"] = 0;
    // v grows upwards on this square, so the image is upside down and the handedness negative.
    const Scene s = g.load();
    ASSERT_EQ(s.tangents.size(), 4u);
    for (vec4 t : s.tangents) expect_near(t, vec4(1, 0, 0, -1));
}

}  // namespace lw::test
