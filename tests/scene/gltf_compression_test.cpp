// Compressed geometry and pictures: Draco, meshopt, WebP.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "scene/gltf_text.h"
#include "scene/webp_row.h"

namespace lw::test {
namespace {

const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::vector<uint16_t> indices{0, 1, 2, 2, 1, 3};

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

std::vector<unsigned char> meshopt_vertices() {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), corners.data(), 4, 12));
    return bytes;
}

TEST(GltfCompression, DracoGivesTheTrianglesThatWereCompressed) {
    const Scene scene = draco_file(draco_square()).load();
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_NEAR(area_of(scene), 1, 1e-6);
}

TEST(GltfCompression, ACutDracoStreamIsRefused) {
    const std::vector<unsigned char> whole = draco_square();
    for (size_t size = 1; size < whole.size(); ++size) {
        const std::string told = refusal_of(draco_file({whole.begin(), whole.begin() + long(size)}));
        EXPECT_NE(told.find("mesh 0 \"lamp\": primitive 0: KHR_draco_mesh_compression"), std::string::npos)
            << size << " bytes: " << told;
    }
}

TEST(GltfCompression, ADracoStreamWithoutANamedAttributeIsRefused) {
    GltfText g = draco_file(draco_square());
    g.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
    EXPECT_NE(refusal_of(g).find("has no attribute 7"), std::string::npos) << refusal_of(g);
}

TEST(GltfCompression, MeshoptGivesTheTrianglesThatWereCompressed) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const Scene scene = meshopt_file(meshopt_vertices(), name).load();
        EXPECT_EQ(scene.triangles.size(), 2u) << name;
        EXPECT_NEAR(area_of(scene), 1, 1e-6) << name;
    }
}

TEST(GltfCompression, ADamagedOrNewerMeshoptStreamIsRefused) {
    std::vector<unsigned char> newer = meshopt_vertices();
    newer[0] = 0xa1;
    EXPECT_NE(refusal_of(meshopt_file(newer)).find("of a version that this program does not know"), std::string::npos);
    const std::vector<unsigned char> whole = meshopt_vertices();
    for (size_t size = 1; size < whole.size(); ++size)
        EXPECT_NE(refusal_of(meshopt_file({whole.begin(), whole.begin() + long(size)})).find("stream is damaged"),
                  std::string::npos)
            << size;
    GltfText g = meshopt_file(whole);
    g.doc["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 100000;
    EXPECT_NE(refusal_of(g).find("buffer view 0: reaches past the end of buffer 0"), std::string::npos)
        << refusal_of(g);
}

TEST(GltfCompression, AFallbackBufferNeedsNoBytes) {
    GltfText g = meshopt_file(meshopt_vertices());
    for (Json& view : g.doc["bufferViews"]) view["buffer"] = 1;
    Json file = Json::parse(g.text());
    file["buffers"].push_back(
        {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    EXPECT_NEAR(area_of(load_gltf(GltfText::write(file.dump(), "fallback.gltf"))), 1, 1e-6);
}

TEST(GltfCompression, WebpPicturesAreDecoded) {
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

}  // namespace
}  // namespace lw::test
