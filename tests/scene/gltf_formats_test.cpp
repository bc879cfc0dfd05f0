// What exporters write beside plain glTF 2.0: compressed geometry, other pictures and materials, figures, hidden nodes.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::vector<uint16_t> indices{0, 1, 2, 2, 1, 3};

std::string refusal(const GltfText& g) {
    return load_error_of([&] { g.load(); });
}

bool warns(const Scene& scene, const std::string& words) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

double area_of(const Scene& scene) {
    double area = 0;
    for (size_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
    return area;
}

std::vector<unsigned char> draco_square() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (uint32_t f = 0; f < 2; ++f)
        builder.SetAttributeValuesForFace(id, draco::FaceIndex(f), &corners[3 * indices[3 * f]],
                                          &corners[3 * indices[3 * f + 1]], &corners[3 * indices[3 * f + 2]]);
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfText draco_file(const std::vector<unsigned char>& stream) {
    GltfText g;
    g.doc["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    g.doc["accessors"] = {{{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}},
                          {{"componentType", 5123}, {"type", "SCALAR"}, {"count", 6}}};
    g.attribute("POSITION", 0);
    g.primitive()["indices"] = 1;
    g.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", g.view(stream)},
                                                                 {"attributes", {{"POSITION", 0}}}};
    return g;
}

/// A square whose positions and indices are meshopt streams over a fallback buffer without bytes.
GltfText meshopt_file(std::vector<unsigned char> vertices, const std::string& name = "EXT_meshopt_compression") {
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(6, 4));
    const std::vector<unsigned> wide(indices.begin(), indices.end());
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), wide.data(), wide.size()));
    GltfText g;
    g.doc["extensionsRequired"] = {name};
    const int positions = g.view(vertices), faces = g.view(triangles);
    const auto compress = [&](int view, const char* mode, size_t count, size_t stride) {
        Json& plain = g.doc["bufferViews"][size_t(view)];
        Json stream = plain;
        stream["mode"] = mode, stream["count"] = count, stream["byteStride"] = stride;
        plain = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", count * stride}, {"extensions", {{name, stream}}}};
    };
    compress(positions, "ATTRIBUTES", 4, 12);
    compress(faces, "TRIANGLES", 6, 2);
    g.doc["accessors"] = {{{"bufferView", positions}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}},
                          {{"bufferView", faces}, {"componentType", 5123}, {"type", "SCALAR"}, {"count", 6}}};
    g.attribute("POSITION", 0);
    g.primitive()["indices"] = 1;
    return g;
}

/// A lossless WebP file of one row of RGBA pixels.
std::vector<unsigned char> webp_row(const std::vector<uint8_t>& rgba) {
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(rgba.data(), int(rgba.size() / 4), 1, int(rgba.size()), &encoded);
    const std::vector<unsigned char> bytes(encoded, encoded + size);
    WebPFree(encoded);
    return bytes;
}

std::vector<unsigned char> meshopt_vertices() {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), corners.data(), 4, 12));
    return bytes;
}

TEST(GltfFormats, DracoGivesTheTrianglesThatWereCompressed) {
    const Scene scene = draco_file(draco_square()).load();
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_NEAR(area_of(scene), 1, 1e-6);
}

TEST(GltfFormats, ACutDracoStreamIsRefused) {
    const std::vector<unsigned char> whole = draco_square();
    for (size_t size = 1; size < whole.size(); ++size) {
        const std::string told = refusal(draco_file({whole.begin(), whole.begin() + long(size)}));
        EXPECT_NE(told.find("mesh 0 \"lamp\": primitive 0: KHR_draco_mesh_compression"), std::string::npos)
            << size << " bytes: " << told;
    }
}

TEST(GltfFormats, ADracoStreamWithoutANamedAttributeIsRefused) {
    GltfText g = draco_file(draco_square());
    g.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
    EXPECT_NE(refusal(g).find("has no attribute 7"), std::string::npos) << refusal(g);
}

TEST(GltfFormats, MeshoptGivesTheTrianglesThatWereCompressed) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const Scene scene = meshopt_file(meshopt_vertices(), name).load();
        EXPECT_EQ(scene.triangles.size(), 2u) << name;
        EXPECT_NEAR(area_of(scene), 1, 1e-6) << name;
    }
}

TEST(GltfFormats, ADamagedOrNewerMeshoptStreamIsRefused) {
    std::vector<unsigned char> newer = meshopt_vertices();
    newer[0] = 0xa1;
    EXPECT_NE(refusal(meshopt_file(newer)).find("of a version that this program does not know"), std::string::npos);
    const std::vector<unsigned char> whole = meshopt_vertices();
    for (size_t size = 1; size < whole.size(); ++size)
        EXPECT_NE(refusal(meshopt_file({whole.begin(), whole.begin() + long(size)})).find("stream is damaged"),
                  std::string::npos)
            << size;
    GltfText g = meshopt_file(whole);
    g.doc["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 100000;
    EXPECT_NE(refusal(g).find("buffer view 0: reaches past the end of buffer 0"), std::string::npos) << refusal(g);
}

TEST(GltfFormats, AFallbackBufferNeedsNoBytes) {
    GltfText g = meshopt_file(meshopt_vertices());
    for (Json& view : g.doc["bufferViews"]) view["buffer"] = 1;
    Json file = Json::parse(g.text());
    file["buffers"].push_back(
        {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    EXPECT_NEAR(area_of(load_gltf(GltfText::write(file.dump(), "fallback.gltf"))), 1, 1e-6);
}

TEST(GltfFormats, WebpPicturesAreDecoded) {
    const std::vector<unsigned char> bytes = webp_row({200, 100, 50, 255, 10, 20, 30, 128});
    GltfText g = square();
    g.floats("TEXCOORD_0", {0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    g.doc["images"] = {{{"bufferView", g.view(bytes)}, {"mimeType", "image/webp"}}};
    g.doc["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    g.doc["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    g.doc["extensionsRequired"] = {"EXT_texture_webp"};
    g.primitive()["material"] = 0;
    const Scene scene = g.load();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    ASSERT_EQ(scene.textures.size(), 1u);
    ASSERT_EQ(scene.texels.size(), 2u);
    EXPECT_EQ(scene.texels[0], 0xff3264c8u);
    EXPECT_EQ(scene.texels[1], 0x801e140au);
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
    EXPECT_NE(refusal(g).find("has no light"), std::string::npos);
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
    EXPECT_NE(refusal(g).find("names joint 1 of a skin that has 1"), std::string::npos) << refusal(g);
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
    EXPECT_NE(refusal(g).find("requires the extension EXT_mesh_something"), std::string::npos);
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
