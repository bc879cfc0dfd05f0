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

constexpr const char* white_png =  // 1 x 1, base64
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";

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
    GltfText g = square();
    const auto outside = GltfText::write("", "room.gltf").parent_path().parent_path() / "lumenwalk_outside.bin";
    std::ofstream(outside, std::ios::binary).write(reinterpret_cast<const char*>(g.bytes.data()), long(g.bytes.size()));
    for (const std::string& uri :
         {std::string("../lumenwalk_outside.bin"), std::string("%2e%2e/lumenwalk_outside.bin"), outside.string(),
          "file://" + outside.string(), std::string("..\\lumenwalk_outside.bin"), std::string("c:a.bin")}) {
        Json doc = g.doc;
        doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", uri}}};
        const std::string told = error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); });
        EXPECT_NE(told.find("is not inside the folder of the file"), std::string::npos) << uri << ": " << told;
        GltfText profile = square();
        profile.doc["extensionsUsed"].push_back("EXT_lights_ies");
        profile.doc["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", uri}}};
        profile.node()["extensions"]["EXT_lights_ies"]["light"] = 0;
        EXPECT_NE(message(profile).find("is not inside the folder of the file"), std::string::npos) << message(profile);
    }
    std::filesystem::remove(outside);
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "$(touch x).bin"}}};  // no shell is asked
    EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    EXPECT_FALSE(std::filesystem::exists("x"));
}

TEST(GltfErrors, AFileThatCannotBeReadIsNamed) {
    EXPECT_EQ(error_of([] { load_gltf("/nowhere/room.glb"); }), "/nowhere/room.glb: cannot be opened");
    EXPECT_EQ(error_of([] { load_gltf("/"); }), "/: cannot be opened");
    const std::string shorter = "/sys/kernel/mm/transparent_hugepage/enabled";  // than the 4096 bytes it claims
    if (std::filesystem::exists(shorter)) {
        EXPECT_EQ(error_of([&] { load_gltf(shorter); }), shorter + ": cannot be read");
    }
    const auto large = GltfText::write("glTF", "large.glb");
    std::filesystem::resize_file(large, uint64_t(1) << 32);  // sparse
    EXPECT_NE(error_of([&] { load_gltf(large); }).find("larger than 4 GiB"), std::string::npos);
    std::filesystem::remove(large);
}

TEST(GltfErrors, ExternalBufferBesideTheFile) {
    GltfText g = square();
    GltfText::write(std::string(g.bytes.begin(), g.bytes.end()), "room one.bin");
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "room%20one.bin"}}};
    EXPECT_EQ(load_gltf(GltfText::write(doc.dump(), "room.gltf")).triangles.size(), 2u);
}

TEST(GltfErrors, NotGltfAtAll) {
    const auto refused = [](const std::string& text, const char* named) {
        const std::string told = error_of([&] { load_gltf(GltfText::write(text, "room.gltf")); });
        EXPECT_NE(told.find(named), std::string::npos) << text << ": " << told;
    };
    for (const char* text : {"", "{", "hello"}) refused(text, "room.gltf: not valid JSON");
    for (const char* text : {"[]", "{}", "null", "3"}) refused(text, "room.gltf: has no asset.version");
    refused(R"({"asset": {"version": "1.0"}})", "room.gltf: is glTF 1.0, not 2.0");
    const std::string deep =
        R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_EQ(error_of([&] { load_gltf(GltfText::write(deep, "room.gltf")); }), "room.gltf: JSON is nested too deeply");
}

TEST(GltfErrors, ABinaryFileCutAnywhereIsRefused) {
    const std::string whole = square_glb();
    ASSERT_EQ(load_gltf(GltfText::write(whole, "room.glb")).triangles.size(), 2u);
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::string told = error_of([&] { load_gltf(GltfText::write(whole.substr(0, length), "room.glb")); });
        EXPECT_NE(told.find(length < 4 ? "not valid JSON" : "truncated: " + std::to_string(length)), std::string::npos)
            << length << ": " << told;
    }
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

TEST(GltfErrors, EveryIndexOutOfRangeIsNamed) {
    const auto refused = [](const char* named, const auto& bend) {
        GltfText g = square();
        bend(g);
        EXPECT_NE(message(g).find(named), std::string::npos) << named << ": " << message(g);
    };
    refused("there is no material 3", [](GltfText& g) { g.primitive()["material"] = 3; });
    refused("there is no mesh 2", [](GltfText& g) { g.node()["mesh"] = 2; });
    refused("there is no camera 1", [](GltfText& g) { g.node()["camera"] = 1; });
    refused("there is no scene 5", [](GltfText& g) { g.doc["scene"] = 5; });
    refused("there is no accessor 77", [](GltfText& g) { g.primitive()["attributes"]["POSITION"] = 77; });
    refused("indices accessor out of bounds", [](GltfText& g) { g.primitive()["indices"] = 77; });
    refused("there is no buffer view 9", [](GltfText& g) { g.doc["accessors"][0]["bufferView"] = 9; });
    refused("buffer", [](GltfText& g) { g.doc["bufferViews"][0]["buffer"] = 4; });
    refused("there is no light 8",
            [](GltfText& g) { g.doc["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 8; });
    refused("there is no light -1",
            [](GltfText& g) { g.doc["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = -1; });
    refused("there is no texture 6", [](GltfText& g) {
        g.doc["materials"] = {{{"emissiveTexture", {{"index", 6}}}}};
        g.primitive()["material"] = 0;
    });
}

/// Each of these was found by taking its check away: no test failed.
TEST(GltfErrors, WhatOnlyOneCheckRefusesIsNamed) {
    const auto refused = [](const char* named, const auto& bend) {
        GltfText g = square();
        bend(g);
        EXPECT_NE(message(g).find(named), std::string::npos) << named << ": " << message(g);
    };
    const auto with_material = [](GltfText& g, const Json& material) {
        g.doc["materials"] = Json::array({material});
        g.primitive()["material"] = 0;
    };
    refused("byteStride is smaller than an element", [](GltfText& g) { g.doc["bufferViews"][0]["byteStride"] = 4; });
    refused("indices must be unsigned scalars", [](GltfText& g) {
        g.primitive()["indices"] = g.accessor(std::vector<float>{0, 1, 2}, "SCALAR", 5126);
    });
    refused("differ in length", [](GltfText& g) { g.floats("NORMAL", {0, 0, 1}, "VEC3"); });
    refused("has the wrong type", [](GltfText& g) { g.floats("NORMAL", {0, 1, 0, 1, 0, 1, 0, 1}, "VEC2"); });
    refused("a sparse index is out of range", [](GltfText& g) {
        const int places = g.accessor(std::vector<uint32_t>{9}, "SCALAR", 5125);
        const int values = g.accessor(std::vector<float>{0, 0, 0}, "VEC3", 5126);
        const auto view = [&](int accessor) { return g.doc["accessors"][size_t(accessor)]["bufferView"]; };
        g.doc["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view(places)}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", view(values)}}}};
    });
    refused("sparse indices must be unsigned", [](GltfText& g) {
        const int places = g.accessor(std::vector<int16_t>{1}, "SCALAR", 5122);
        const int values = g.accessor(std::vector<float>{0, 0, 0}, "VEC3", 5126);
        const auto view = [&](int accessor) { return g.doc["accessors"][size_t(accessor)]["bufferView"]; };
        g.doc["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view(places)}, {"componentType", 5122}}},
                                           {"values", {{"bufferView", view(values)}}}};
    });
    refused("node 2: the transformation is not finite", [](GltfText& g) {
        g.node()["scale"] = {1e200, 1, 1};
        g.node()["children"] = {2};
        g.doc["nodes"].push_back({{"scale", {1e200, 1, 1}}});
    });
    refused("EXT_mesh_gpu_instancing: instance 1 is not finite", [](GltfText& g) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const int places = g.accessor(std::vector<float>{0, 0, 0, nan, 0, 0}, "VEC3", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    });
    refused("EXT_mesh_gpu_instancing: TRANSLATION has the wrong size", [](GltfText& g) {
        const int places = g.accessor(std::vector<float>{0, 0}, "VEC2", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    });
    refused("EXT_mesh_gpu_instancing: SCALE has the wrong size", [](GltfText& g) {
        const int places = g.accessor(std::vector<float>(6, 0), "VEC3", 5126);
        const int sizes = g.accessor(std::vector<float>(9, 1), "VEC3", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}, {"SCALE", sizes}};
    });
    refused("there is no sampler 9", [&](GltfText& g) {
        g.doc["images"] = {{{"uri", "data:image/png;base64," + std::string(white_png)}}};
        g.doc["textures"] = {{{"source", 0}, {"sampler", 9}}};
        with_material(g, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    });
    refused("thicknessFactor must not be negative", [&](GltfText& g) {
        with_material(g, {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", -1}}}}}});
    });
    refused("attenuationDistance must be positive", [&](GltfText& g) {
        with_material(
            g, {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", -1}}}}}});
    });
    refused("ior must be 0 or at least 1", [&](GltfText& g) {
        with_material(g, {{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}});
    });
}

TEST(GltfErrors, LongCyclesAndTwoParents) {
    GltfText cycle = square();
    cycle.node()["children"] = {2};
    cycle.doc["nodes"].push_back({{"children", {3}}});
    cycle.doc["nodes"].push_back({{"children", {0}}});
    EXPECT_NE(message(cycle).find("is its own ancestor or has two parents"), std::string::npos) << message(cycle);
    GltfText shared = square();
    shared.doc["nodes"].push_back({{"name", "both"}});
    shared.doc["nodes"][0]["children"] = {2};
    shared.doc["nodes"][1]["children"] = {2};
    EXPECT_NE(message(shared).find("node 2 \"both\": is its own ancestor or has two parents"), std::string::npos);
    GltfText rootless = square();
    rootless.doc.erase("scenes"), rootless.doc.erase("scene");
    rootless.node()["children"] = {1};
    rootless.doc["nodes"][1]["children"] = {0};
    EXPECT_EQ(message(rootless), "room.gltf: the scene has no triangles");
}

TEST(GltfErrors, AMillionNodesDeepIsNoDeepRecursion) {
    GltfText g = square();
    Json nodes = Json::array({g.doc["nodes"][0], g.doc["nodes"][1]});
    for (int i = 2; i < 100'000; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back(Json::object());
    nodes[0]["children"] = {2};
    g.doc["nodes"] = nodes;
    EXPECT_EQ(message(g), "");
}

TEST(GltfErrors, MissingFilesAreNamed) {
    GltfText g = square();
    Json doc = g.doc;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "lost.bin"}}};
    const std::string lost = error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); });
    EXPECT_NE(lost.find("lost.bin"), std::string::npos) << lost;
    doc["buffers"] = {{{"byteLength", g.bytes.size()}}};
    EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    doc.erase("buffers");
    EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    GltfText::write(std::string(g.bytes.begin(), g.bytes.end() - 1), "short.bin");
    doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "short.bin"}}};
    EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "");
    GltfText image = square();
    image.doc["images"] = {{{"uri", "lost.png"}}};
    image.doc["textures"] = {{{"source", 0}}};
    image.doc["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    image.primitive()["material"] = 0;
    const Scene s = image.load();
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_NE(s.warnings[0].find("image 0"), std::string::npos) << s.warnings[0];
}

TEST(GltfErrors, DataUrisCutAnywhereAreRefused) {
    const GltfText g = square();
    const std::string whole = "data:application/octet-stream;base64," + base64(g.bytes);
    for (size_t length = 1; length + 4 < whole.size(); ++length) {
        Json doc = g.doc;
        doc["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", whole.substr(0, length)}}};
        EXPECT_NE(error_of([&] { load_gltf(GltfText::write(doc.dump(), "room.gltf")); }), "") << length;
    }
}

TEST(GltfErrors, ABinaryFileWithAWrongHeader) {
    const std::string whole = square_glb();
    const auto refused = [&](size_t at, const std::string& bytes, const char* named) {
        std::string changed = whole;
        changed.replace(at, bytes.size(), bytes);
        const std::string told = error_of([&] { load_gltf(GltfText::write(changed, "room.glb")); });
        EXPECT_NE(told.find(named), std::string::npos) << at << ": " << told;
    };
    refused(0, "glTX", "not valid JSON");
    refused(4, std::string("\1\0\0\0", 4), "GLB version 1");
    refused(8, "\xff\xff\xff\xff", "truncated");
    refused(12, "\xff\xff\xff\xff", "longer than the file");
    refused(12, std::string(4, '\0'), "");
    refused(16, "NOSJ", "");
}

TEST(GltfErrors, ClaimedElementsCostNothing) {
    GltfText g = square();
    g.doc["accessors"][0].erase("bufferView");
    for (const uint64_t count : {uint64_t(1'000'000'000), uint64_t(1) << 23}) {
        g.doc["accessors"][0]["count"] = count;
        EXPECT_NE(message(g).find("has too many elements"), std::string::npos) << message(g);
    }
}

/// One accessor of a million zeros, drawn by many nodes: 2e10 vertices from a file of a megabyte.
TEST(GltfErrors, AShortFileCannotAskForAllMemory) {
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
    EXPECT_NE(message(g).find("than 2^32"), std::string::npos) << message(g);
    g.doc["scenes"][0]["nodes"] = Json::array({1});
    for (int i = 0; i < 3000; ++i) g.doc["scenes"][0]["nodes"].push_back(2 + i);
    EXPECT_NE(message(g).find("triangles take"), std::string::npos) << message(g);
}

TEST(GltfErrors, FactorsBeyondTheFloatsAreRefusedOrBounded) {
    GltfText g = square();
    g.primitive()["material"] = 0;
    const auto material = [&](const Json& m) {
        g.doc["materials"] = Json::array({m});
        return message(g);
    };
    EXPECT_NE(material({{"emissiveFactor", {1e300, 0, 0}}}).find("the emission is not finite"), std::string::npos);
    EXPECT_NE(material({{"normalTexture", {{"index", 0}, {"scale", 1e300}}}}), "");
    const Json specular = {{"KHR_materials_specular", {{"specularColorFactor", {1e300, 1, 1}}}}};
    EXPECT_NE(material({{"extensions", specular}}).find("a factor is not finite"), std::string::npos);
    EXPECT_EQ(material({{"pbrMetallicRoughness", {{"roughnessFactor", 1e300}}}}), "");
    GltfText bright = square();
    bright.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 1e300;
    EXPECT_NE(message(bright).find("the intensity is not finite"), std::string::npos);
    GltfText camera = square();
    camera.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1e300}, {"aspectRatio", 1e-300}}}}};
    camera.doc["cameras"][0]["perspective"]["znear"] = 1e-300;
    camera.node()["camera"] = 0;
    const Scene s = camera.load();
    EXPECT_GT(s.cameras[0].near, 0);
    EXPECT_GE(s.cameras[0].aspect, 1e-3f);
    camera.doc["nodes"].push_back({{"camera", 0}, {"translation", {1e20, 0, 0}}});
    camera.doc["scenes"][0]["nodes"].push_back(2);
    EXPECT_NE(message(camera).find("the camera is too far away"), std::string::npos) << message(camera);
}

TEST(GltfErrors, VertexColoursOutsideTheirRangeMakeNoLight) {
    GltfText g = square();
    g.floats("COLOR_0", {-1, 2, 0.5f, 1, 1e30f, -1e30f, 0, 1, 0, 0, 0, 0, 1, 1, 1, 7}, "VEC4");
    const Scene s = g.load();
    for (const vec4& c : s.colors)
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << c[i];
}

}  // namespace lw::test
