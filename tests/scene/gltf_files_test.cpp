// The file as a whole: cut, unreadable, with neighbours that are missing or outside of its folder.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

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

TEST(GltfFiles, AnUnreadableImageOfAGlbIsNoReasonToRefuseIt) {
    const std::string glb = square_glb(Json::array({{{"uri", "data:image/png;base64,!!!!"}}}));
    Scene s;
    EXPECT_EQ(load_error_of([&] { s = load_gltf(GltfText::write(glb, "room.glb")); }), "");
    EXPECT_EQ(s.triangles.size(), 2u);
}

TEST(GltfFiles, UrisStayInTheFolder) {
    GltfText g = square();
    const auto outside = GltfText::write("", "room.gltf").parent_path().parent_path() / "lumenwalk_outside.bin";
    std::ofstream(outside, std::ios::binary).write(reinterpret_cast<const char*>(g.bytes.data()), long(g.bytes.size()));
    for (const std::string& uri :
         {std::string("../lumenwalk_outside.bin"), std::string("%2e%2e/lumenwalk_outside.bin"), outside.string(),
          "file://" + outside.string(), std::string("..\\lumenwalk_outside.bin"), std::string("c:a.bin")}) {
        Json doc = g.doc;
        doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", uri}}};
        const std::string told = load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); });
        EXPECT_NE(told.find("is not inside the folder of the file"), std::string::npos) << uri << ": " << told;
        GltfText profile = square();
        profile.doc["extensionsUsed"].push_back("EXT_lights_ies");
        profile.doc["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", uri}}};
        profile.node()["extensions"]["EXT_lights_ies"]["light"] = 0;
        EXPECT_NE(refusal_of(profile).find("is not inside the folder of the file"), std::string::npos)
            << refusal_of(profile);
    }
    std::filesystem::remove(outside);
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "$(touch x).bin"}}};  // no shell is asked
    EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    EXPECT_FALSE(std::filesystem::exists("x"));
}

TEST(GltfFiles, AFileThatCannotBeReadIsNamed) {
    EXPECT_EQ(load_error_of([] { load_gltf("/nowhere/room.glb"); }), "/nowhere/room.glb: cannot be opened");
    EXPECT_EQ(load_error_of([] { load_gltf("/"); }), "/: cannot be opened");
    const std::string shorter = "/sys/kernel/mm/transparent_hugepage/enabled";  // than the 4096 bytes it claims
    if (std::filesystem::exists(shorter)) {
        EXPECT_EQ(load_error_of([&] { load_gltf(shorter); }), shorter + ": cannot be read");
    }
    const auto large = GltfText::write("glTF", "large.glb");
    std::filesystem::resize_file(large, uint64_t(1) << 32);  // sparse
    EXPECT_NE(load_error_of([&] { load_gltf(large); }).find("larger than 4 GiB"), std::string::npos);
    std::filesystem::remove(large);
}

TEST(GltfFiles, ExternalBufferBesideTheFile) {
    GltfText g = square();
    GltfText::write(std::string(g.bytes.begin(), g.bytes.end()), "room one.bin");
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "room%20one.bin"}}};
    const std::filesystem::path path = GltfText::write(doc.dump(), "room.gltf");
    const Scene scene = load_gltf(path);
    EXPECT_EQ(scene.triangles.size(), 2u);
    ASSERT_EQ(scene.files.size(), 2u) << "no output may take their place";
    EXPECT_TRUE(std::filesystem::equivalent(scene.files[0], path));
    EXPECT_TRUE(std::filesystem::equivalent(scene.files[1], path.parent_path() / "room one.bin"));
}

TEST(GltfFiles, NotGltfAtAll) {
    const auto refused = [](const std::string& text, const char* named) {
        const std::string told = load_error_of([&] { load_gltf(GltfText::write(text, "room.gltf")); });
        EXPECT_NE(told.find(named), std::string::npos) << text << ": " << told;
    };
    for (const char* text : {"", "{", "hello"}) refused(text, "room.gltf: not valid JSON");
    for (const char* text : {"[]", "{}", "null", "3"}) refused(text, "room.gltf: has no asset.version");
    refused(R"({"asset": {"version": "1.0"}})", "room.gltf: is glTF 1.0, not 2.0");
    const std::string deep =
        R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_EQ(load_error_of([&] { load_gltf(GltfText::write(deep, "room.gltf")); }),
              "room.gltf: JSON is nested too deeply");
}

TEST(GltfFiles, ABinaryFileCutAnywhereIsRefused) {
    const std::string whole = square_glb();
    ASSERT_EQ(load_gltf(GltfText::write(whole, "room.glb")).triangles.size(), 2u);
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::string told =
            load_error_of([&] { load_gltf(GltfText::write(whole.substr(0, length), "room.glb")); });
        EXPECT_NE(told.find(length < 4 ? "not valid JSON" : "truncated: " + std::to_string(length)), std::string::npos)
            << length << ": " << told;
    }
}

TEST(GltfFiles, ABinaryFileCutWithItsLengthRewrittenNeverCrashes) {
    const std::string whole = square_glb();
    for (size_t length = 20; length < whole.size(); ++length) {
        std::string cut = whole.substr(0, length);
        for (size_t k = 0; k < 4; ++k) cut[8 + k] = char(length >> (8 * k) & 255);
        EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(cut, "room.glb")); }), "") << length;
    }
}

TEST(GltfFiles, AnyByteOfTheJsonChangedLoadsOrThrowsError) {
    const std::string whole = square_glb();
    for (size_t at = 20; at < whole.size(); ++at)
        for (const char byte : {'9', '-', '\xff'}) {
            std::string changed = whole;
            changed[at] = byte;
            load_error_of([&] { load_gltf(GltfText::write(changed, "room.glb")); });
        }
}

TEST(GltfFiles, TheApartmentCutAtManyLengths) {
    const std::string whole = bytes_of(LUMENWALK_SOURCE_DIR "/data/apartment.glb");
    ASSERT_GT(whole.size(), 1000u);
    for (size_t length : {size_t(3), size_t(19), size_t(21), size_t(5000), whole.size() / 2, whole.size() - 1})
        EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(whole.substr(0, length), "cut.glb")); }), "") << length;
}

TEST(GltfFiles, MissingFilesAreNamed) {
    GltfText g = square();
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "lost.bin"}}};
    const std::string lost = load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); });
    EXPECT_NE(lost.find("lost.bin"), std::string::npos) << lost;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}}};
    EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    doc.erase("buffers");
    EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    GltfText::write(std::string(g.bytes.begin(), g.bytes.end() - 1), "short.bin");
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "short.bin"}}};
    EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    GltfText image = square();
    image.doc["images"] = {{{"uri", "lost.png"}}};
    image.doc["textures"] = {{{"source", 0}}};
    image.doc["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    image.primitive()["material"] = 0;
    const Scene s = image.load();
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_NE(s.warnings[0].find("image 0"), std::string::npos) << s.warnings[0];
}

TEST(GltfFiles, DataUrisCutAnywhereAreRefused) {
    const GltfText g = square();
    const std::string whole = "data:application/octet-stream;base64," + base64(g.bytes);
    for (size_t length = 1; length + 4 < whole.size(); ++length) {
        Json doc = g.doc;
        doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", whole.substr(0, length)}}};
        EXPECT_NE(load_error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "") << length;
    }
}

TEST(GltfFiles, ABinaryFileWithAWrongHeader) {
    const std::string whole = square_glb();
    const auto refused = [&](size_t at, const std::string& bytes, const char* named) {
        std::string changed = whole;
        changed.replace(at, bytes.size(), bytes);
        const std::string told = load_error_of([&] { load_gltf(GltfText::write(changed, "room.glb")); });
        EXPECT_NE(told, "") << at;
        EXPECT_NE(told.find(named), std::string::npos) << at << ": " << told;
    };
    refused(0, "glTX", "not valid JSON");
    refused(4, std::string("\1\0\0\0", 4), "GLB version 1");
    refused(8, "\xff\xff\xff\xff", "truncated");
    refused(12, "\xff\xff\xff\xff", "longer than the file");
    refused(12, std::string(4, '\0'), "");
    refused(16, "NOSJ", "");
}

/// One accessor of a million zeros, drawn by many nodes: 2e10 vertices from a file of a megabyte.
TEST(GltfFiles, AShortFileCannotAskForAllMemory) {
    GltfText g = square();
    g.doc["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 1 << 20}});
    g.doc["accessors"][0] = g.doc["accessors"].back();
    g.primitive()["attributes"].erase("NORMAL");
    g.primitive().erase("indices");
    Json node = g.doc["nodes"][0];
    for (int i = 0; i < 20'000; ++i) {
        g.doc["nodes"].push_back(node);
        g.doc["scenes"][0]["nodes"].push_back(2 + i);
    }
    EXPECT_NE(refusal_of(g).find("than 2^32"), std::string::npos) << refusal_of(g);
    g.doc["scenes"][0]["nodes"] = Json::array({1});
    for (int i = 0; i < 3000; ++i) g.doc["scenes"][0]["nodes"].push_back(2 + i);
    EXPECT_NE(refusal_of(g).find("triangles take"), std::string::npos) << refusal_of(g);
}

}  // namespace lw::test
