#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

std::string message(const GltfText& g) {
    return error_of([&] { g.load(); });
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The square as a GLB: a JSON chunk and a BIN chunk.
std::string square_glb(const Json& images = Json()) {
    GltfText g = square();
    if (!images.is_null()) g.doc["images"] = images;
    while (g.bytes.size() % 4) g.bytes.push_back(0);
    g.doc["buffers"] = {{{"byteLength", g.bytes.size()}}};
    std::string json = g.doc.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](size_t value) {
        return std::string{char(value & 255), char(value >> 8 & 255), char(value >> 16 & 255), char(value >> 24)};
    };
    return "glTF" + word(2) + word(28 + json.size() + g.bytes.size()) + word(json.size()) + "JSON" + json +
           word(g.bytes.size()) + std::string("BIN\0", 4) + std::string(g.bytes.begin(), g.bytes.end());
}

}  // namespace

TEST(GltfErrors, RequiredExtensionIsRefusedByName) {
    GltfText g = square();
    g.doc["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_EQ(message(g), "room.gltf: requires the extension KHR_draco_mesh_compression, which is not supported");
}

TEST(GltfErrors, UsedExtensionThatChangesTheLookIsToldOnce) {
    GltfText g = square();
    g.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_clearcoat"};
    const Scene s = g.load();
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_NE(s.warnings[0].find("KHR_materials_clearcoat"), std::string::npos);
}

TEST(GltfErrors, AnUnreadableImageOfAGlbIsNoReasonToRefuseIt) {
    const std::string glb = square_glb(Json::array({{{"uri", "data:image/png;base64,!!!!"}}}));
    Scene s;
    EXPECT_EQ(error_of([&] { s = load_gltf(GltfText::write(glb, "room.glb")); }), "");
    EXPECT_EQ(s.triangles.size(), 2u);
}

TEST(GltfErrors, TooFarForFloats) {
    GltfText g = square();
    g.node()["translation"] = {1e30, 0, 0};
    EXPECT_NE(message(g).find("light 0: the position is too far away"), std::string::npos) << message(g);
    g = square();
    g.node()["scale"] = {1e12, 1, 1};
    EXPECT_EQ(message(g), "room.gltf: the scene is larger than 1e9 m");
}

TEST(GltfErrors, NoPosition) {
    GltfText g = square();
    g.primitive()["attributes"].erase("POSITION");
    EXPECT_EQ(message(g), "room.gltf: mesh 0 \"lamp\": primitive 0 has no POSITION");
}

TEST(GltfErrors, IndexOutOfRange) {
    GltfText g = square();
    g.primitive()["indices"] = g.accessor(std::vector<uint8_t>{0, 1, 4}, "SCALAR", 5121);
    EXPECT_EQ(message(g), "room.gltf: mesh 0 \"lamp\": primitive 0: index 4 is out of range, there are 4 vertices");
}

TEST(GltfErrors, AccessorPastItsView) {
    for (const uint64_t count : {uint64_t(5), uint64_t(1) << 30, uint64_t(1) << 40, ~uint64_t(0) / 12}) {
        GltfText g = square();
        g.doc["accessors"][0]["count"] = count;
        EXPECT_NE(message(g), "") << count;
    }
    GltfText offset = square();
    offset.doc["accessors"][0]["byteOffset"] = 4;
    EXPECT_NE(message(offset).find("reaches past the end of buffer view 0"), std::string::npos) << message(offset);
    GltfText view = square();
    view.doc["bufferViews"][0]["byteLength"] = uint64_t(1) << 62;
    EXPECT_NE(message(view), "");
    GltfText image = square();
    image.doc["bufferViews"][0]["byteOffset"] = 100000;
    EXPECT_NE(message(image), "");
}

TEST(GltfErrors, CyclesAndSharedNodes) {
    GltfText cycle = square();
    cycle.node()["children"] = {0};
    EXPECT_NE(message(cycle).find("node 0 \"thing\": is its own ancestor"), std::string::npos) << message(cycle);
    GltfText missing = square();
    missing.node()["children"] = {7};
    EXPECT_EQ(message(missing), "room.gltf: there is no node 7");
}

TEST(GltfErrors, NoLightGivesAdvice) {
    GltfText g = square();
    g.doc["scenes"][0]["nodes"] = {0};
    EXPECT_NE(message(g).find("has no light: add a"), std::string::npos);
}

TEST(GltfErrors, NoTriangles) {
    GltfText g = square();
    g.doc["scenes"][0]["nodes"] = {1};
    EXPECT_EQ(message(g), "room.gltf: the scene has no triangles");
}

TEST(GltfErrors, PositionThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfText g;
        g.floats("POSITION", {0, 0, 0, 1, 0, bad, 0, 1, 0}, "VEC3");
        EXPECT_EQ(message(g), "room.gltf: mesh 0 \"lamp\": primitive 0: the position of vertex 1 is not finite");
    }
}

TEST(GltfErrors, UrisStayInTheFolder) {
    for (const std::string uri :
         {"../a.bin", "/etc/passwd", "a/%2e%2e/../b.bin", "file:///etc/passwd", "..\\a.bin", "$(touch x).bin"}) {
        GltfText g = square();
        Json doc = g.doc;
        doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", uri}}};
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "") << uri;
    }
}

TEST(GltfErrors, ExternalBufferBesideTheFile) {
    GltfText g = square();
    GltfText::write(std::string(g.bytes.begin(), g.bytes.end()), "room one.bin");
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "room%20one.bin"}}};
    EXPECT_EQ(load_gltf(GltfText::write(doc.dump(), "room.gltf")).triangles.size(), 2u);
}

TEST(GltfErrors, NotGltfAtAll) {
    for (const std::string text : {"", "{", "hello", "[]", "{}", "null", R"({"asset": {"version": "1.0"}})"})
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(text, "room.gltf")); }), "") << text;
    EXPECT_NE(error_of([] { load_gltf("/nowhere/room.glb"); }), "");
    const std::string deep =
        R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_EQ(error_of([&] { load_gltf(GltfText::write(deep, "room.gltf")); }), "room.gltf: JSON is nested too deeply");
}

TEST(GltfErrors, ABinaryFileCutAnywhereIsRefused) {
    const std::string whole = square_glb();
    ASSERT_EQ(load_gltf(GltfText::write(whole, "room.glb")).triangles.size(), 2u);
    for (size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(whole.substr(0, length), "room.glb")); }), "") << length;
}

TEST(GltfErrors, ABinaryFileCutWithItsLengthRewrittenNeverCrashes) {
    const std::string whole = square_glb();
    for (size_t length = 20; length < whole.size(); ++length) {
        std::string cut = whole.substr(0, length);
        for (size_t k = 0; k < 4; ++k) cut[8 + k] = char(length >> (8 * k) & 255);
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(cut, "room.glb")); }), "") << length;
    }
}

TEST(GltfErrors, AnyByteOfTheJsonChangedLoadsOrThrowsError) {
    const std::string whole = square_glb();
    for (size_t at = 20; at < whole.size(); ++at)
        for (const char byte : {'9', '-', '\xff'}) {
            std::string changed = whole;
            changed[at] = byte;
            error_of([&] { load_gltf(GltfText::write(changed, "room.glb")); });
        }
}

TEST(GltfErrors, TheApartmentCutAtManyLengths) {
    const std::string whole = bytes_of(LUMENWALK_SOURCE_DIR "/data/apartment.glb");
    ASSERT_GT(whole.size(), 1000u);
    for (size_t length : {size_t(3), size_t(19), size_t(21), size_t(5000), whole.size() / 2, whole.size() - 1})
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(whole.substr(0, length), "cut.glb")); }), "") << length;
}

}  // namespace lw::test
