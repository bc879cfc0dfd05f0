#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

constexpr const char* white_png =  // 1 x 1, base64
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";

/// Whether a square bent by `bend` is refused with these words.
template <class Bend>
void expect_refused(const char* words, const Bend& bend) {
    GltfText g = square();
    bend(g);
    EXPECT_NE(refusal_of(g).find(words), std::string::npos) << words << ": " << refusal_of(g);
}

}  // namespace

TEST(GltfErrors, RequiredExtensionIsRefusedByName) {
    GltfText g = square();
    g.doc["extensionsRequired"] = {"EXT_mesh_features"};
    EXPECT_EQ(refusal_of(g), "room.gltf: requires the extension EXT_mesh_features, which is not supported");
}

TEST(GltfErrors, UsedExtensionThatChangesTheLookIsToldOnce) {
    GltfText g = square();
    g.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_clearcoat"};
    const Scene s = g.load();
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_NE(s.warnings[0].find("KHR_materials_clearcoat"), std::string::npos);
}

TEST(GltfErrors, TooFarForFloats) {
    GltfText g = square();
    g.node()["translation"] = {1e30, 0, 0};
    EXPECT_NE(refusal_of(g).find("light 0: the position is too far away"), std::string::npos) << refusal_of(g);
    g = square();
    g.node()["scale"] = {1e12, 1, 1};
    EXPECT_EQ(refusal_of(g), "room.gltf: the scene is larger than 1e9 m");
}

TEST(GltfErrors, NoPosition) {
    GltfText g = square();
    g.primitive()["attributes"].erase("POSITION");
    EXPECT_EQ(refusal_of(g), "room.gltf: mesh 0 \"lamp\": primitive 0 has no POSITION");
}

TEST(GltfErrors, IndexOutOfRange) {
    GltfText g = square();
    g.primitive()["indices"] = g.accessor(std::vector<uint8_t>{0, 1, 4}, "SCALAR", 5121);
    EXPECT_EQ(refusal_of(g), "room.gltf: mesh 0 \"lamp\": primitive 0: index 4 is out of range, there are 4 vertices");
}

TEST(GltfErrors, AccessorPastItsView) {
    for (const uint64_t count : {uint64_t(5), uint64_t(1) << 30, uint64_t(1) << 40, ~uint64_t(0) / 12}) {
        GltfText g = square();
        g.doc["accessors"][0]["count"] = count;
        EXPECT_NE(refusal_of(g), "") << count;
    }
    GltfText offset = square();
    offset.doc["accessors"][0]["byteOffset"] = 4;
    EXPECT_NE(refusal_of(offset).find("reaches past the end of buffer view 0"), std::string::npos)
        << refusal_of(offset);
    GltfText view = square();
    view.doc["bufferViews"][0]["byteLength"] = uint64_t(1) << 62;
    EXPECT_NE(refusal_of(view), "");
    GltfText image = square();
    image.doc["bufferViews"][0]["byteOffset"] = 100000;
    EXPECT_NE(refusal_of(image), "");
}

TEST(GltfErrors, CyclesAndSharedNodes) {
    GltfText cycle = square();
    cycle.node()["children"] = {0};
    EXPECT_NE(refusal_of(cycle).find("node 0 \"thing\": is its own ancestor"), std::string::npos) << refusal_of(cycle);
    GltfText missing = square();
    missing.node()["children"] = {7};
    EXPECT_EQ(refusal_of(missing), "room.gltf: there is no node 7");
}

TEST(GltfErrors, NoLightGivesAdvice) {
    GltfText g = square();
    g.doc["scenes"][0]["nodes"] = {0};
    EXPECT_NE(refusal_of(g).find("has no light: add a"), std::string::npos);
}

TEST(GltfErrors, NoTriangles) {
    GltfText g = square();
    g.doc["scenes"][0]["nodes"] = {1};
    EXPECT_EQ(refusal_of(g), "room.gltf: the scene has no triangles");
}

TEST(GltfErrors, PositionThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfText g;
        g.floats("POSITION", {0, 0, 0, 1, 0, bad, 0, 1, 0}, "VEC3");
        EXPECT_EQ(refusal_of(g), "room.gltf: mesh 0 \"lamp\": primitive 0: the position of vertex 1 is not finite");
    }
}

TEST(GltfErrors, ColourThatIsNotFinite) {
    GltfText g = square();
    std::vector<float> colors(4 * 3, 0.5f);
    colors[7] = std::numeric_limits<float>::quiet_NaN();
    g.floats("COLOR_0", colors, "VEC3");
    EXPECT_EQ(refusal_of(g), "room.gltf: mesh 0 \"lamp\": primitive 0: COLOR_0 of vertex 2 is not finite");
}

TEST(GltfErrors, EveryIndexOutOfRangeIsNamed) {
    const auto refused = [](const char* named, const auto& bend) {
        GltfText g = square();
        bend(g);
        EXPECT_NE(refusal_of(g).find(named), std::string::npos) << named << ": " << refusal_of(g);
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
TEST(GltfErrors, ABadAccessorIsNamed) {
    expect_refused("byteStride is smaller than an element",
                   [](GltfText& g) { g.doc["bufferViews"][0]["byteStride"] = 4; });
    expect_refused("indices must be unsigned scalars", [](GltfText& g) {
        g.primitive()["indices"] = g.accessor(std::vector<float>{0, 1, 2}, "SCALAR", 5126);
    });
    expect_refused("differ in length", [](GltfText& g) { g.floats("NORMAL", {0, 0, 1}, "VEC3"); });
    expect_refused("has the wrong type", [](GltfText& g) { g.floats("NORMAL", {0, 1, 0, 1, 0, 1, 0, 1}, "VEC2"); });
    expect_refused("a sparse index is out of range", [](GltfText& g) {
        const int places = g.accessor(std::vector<uint32_t>{9}, "SCALAR", 5125);
        const int values = g.accessor(std::vector<float>{0, 0, 0}, "VEC3", 5126);
        const auto view = [&](int accessor) { return g.doc["accessors"][size_t(accessor)]["bufferView"]; };
        g.doc["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view(places)}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", view(values)}}}};
    });
    expect_refused("sparse indices must be unsigned", [](GltfText& g) {
        const int places = g.accessor(std::vector<int16_t>{1}, "SCALAR", 5122);
        const int values = g.accessor(std::vector<float>{0, 0, 0}, "VEC3", 5126);
        const auto view = [&](int accessor) { return g.doc["accessors"][size_t(accessor)]["bufferView"]; };
        g.doc["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view(places)}, {"componentType", 5122}}},
                                           {"values", {{"bufferView", view(values)}}}};
    });
}

TEST(GltfErrors, ABadNodeOrInstanceIsNamed) {
    expect_refused("node 2: the transformation is not finite", [](GltfText& g) {
        g.node()["scale"] = {1e200, 1, 1};
        g.node()["children"] = {2};
        g.doc["nodes"].push_back({{"scale", {1e200, 1, 1}}});
    });
    expect_refused("EXT_mesh_gpu_instancing: instance 1 is not finite", [](GltfText& g) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const int places = g.accessor(std::vector<float>{0, 0, 0, nan, 0, 0}, "VEC3", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    });
    expect_refused("EXT_mesh_gpu_instancing: TRANSLATION has the wrong size", [](GltfText& g) {
        const int places = g.accessor(std::vector<float>{0, 0}, "VEC2", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    });
    expect_refused("EXT_mesh_gpu_instancing: SCALE has the wrong size", [](GltfText& g) {
        const int places = g.accessor(std::vector<float>(6, 0), "VEC3", 5126);
        const int sizes = g.accessor(std::vector<float>(9, 1), "VEC3", 5126);
        g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}, {"SCALE", sizes}};
    });
}

TEST(GltfErrors, ABadMaterialIsNamed) {
    expect_refused("there is no sampler 9", [](GltfText& g) {
        g.doc["images"] = {{{"uri", "data:image/png;base64," + std::string(white_png)}}};
        g.doc["textures"] = {{{"source", 0}, {"sampler", 9}}};
        add_material(g, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    });
    expect_refused("thicknessFactor must not be negative", [](GltfText& g) {
        add_material(g, {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", -1}}}}}});
    });
    expect_refused("attenuationDistance must be positive", [](GltfText& g) {
        add_material(
            g, {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", -1}}}}}});
    });
    expect_refused("ior must be 0 or at least 1", [](GltfText& g) {
        add_material(g, {{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}});
    });
}

TEST(GltfErrors, LongCyclesAndTwoParents) {
    GltfText cycle = square();
    cycle.node()["children"] = {2};
    cycle.doc["nodes"].push_back({{"children", {3}}});
    cycle.doc["nodes"].push_back({{"children", {0}}});
    EXPECT_NE(refusal_of(cycle).find("is its own ancestor or has two parents"), std::string::npos) << refusal_of(cycle);
    GltfText shared = square();
    shared.doc["nodes"].push_back({{"name", "both"}});
    shared.doc["nodes"][0]["children"] = {2};
    shared.doc["nodes"][1]["children"] = {2};
    EXPECT_NE(refusal_of(shared).find("node 2 \"both\": is its own ancestor or has two parents"), std::string::npos);
    GltfText rootless = square();
    rootless.doc.erase("scenes"), rootless.doc.erase("scene");
    rootless.node()["children"] = {1};
    rootless.doc["nodes"][1]["children"] = {0};
    EXPECT_EQ(refusal_of(rootless), "room.gltf: the scene has no triangles");
}

TEST(GltfErrors, AMillionNodesDeepIsNoDeepRecursion) {
    GltfText g = square();
    Json nodes = Json::array({g.doc["nodes"][0], g.doc["nodes"][1]});
    for (int i = 2; i < 100'000; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back(Json::object());
    nodes[0]["children"] = {2};
    g.doc["nodes"] = nodes;
    EXPECT_EQ(refusal_of(g), "");
}

TEST(GltfErrors, ClaimedElementsCostNothing) {
    GltfText g = square();
    g.doc["accessors"][0].erase("bufferView");
    for (const uint64_t count : {uint64_t(1'000'000'000), uint64_t(1) << 23}) {
        g.doc["accessors"][0]["count"] = count;
        EXPECT_NE(refusal_of(g).find("has too many elements"), std::string::npos) << refusal_of(g);
    }
}

}  // namespace lw::test
