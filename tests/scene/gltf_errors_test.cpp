#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf_text.h"

namespace lw::test {
namespace {

std::string message(const GltfText& g) {
    return load_error_of([&] { g.load(); });
}

constexpr const char* white_png =  // 1 x 1, base64
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";

/// Whether a square bent by `bend` is refused with these words.
template <class Bend>
void expect_refused(const char* words, const Bend& bend) {
    GltfText g = square();
    bend(g);
    EXPECT_NE(message(g).find(words), std::string::npos) << words << ": " << message(g);
}

void add_material(GltfText& g, const Json& material) {
    g.doc["materials"] = Json::array({material});
    g.primitive()["material"] = 0;
}

}  // namespace

TEST(GltfErrors, RequiredExtensionIsRefusedByName) {
    GltfText g = square();
    g.doc["extensionsRequired"] = {"EXT_mesh_features"};
    EXPECT_EQ(message(g), "room.gltf: requires the extension EXT_mesh_features, which is not supported");
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

TEST(GltfErrors, ColourThatIsNotFinite) {
    GltfText g = square();
    std::vector<float> colors(4 * 3, 0.5f);
    colors[7] = std::numeric_limits<float>::quiet_NaN();
    g.floats("COLOR_0", colors, "VEC3");
    EXPECT_EQ(message(g), "room.gltf: mesh 0 \"lamp\": primitive 0: COLOR_0 of vertex 2 is not finite");
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

TEST(GltfErrors, ClaimedElementsCostNothing) {
    GltfText g = square();
    g.doc["accessors"][0].erase("bufferView");
    for (const uint64_t count : {uint64_t(1'000'000'000), uint64_t(1) << 23}) {
        g.doc["accessors"][0]["count"] = count;
        EXPECT_NE(message(g).find("has too many elements"), std::string::npos) << message(g);
    }
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

TEST(GltfErrors, NumbersOfTheWrongTypeOrSignAreTold) {
    const auto with = [](const char* place, const Json& value) {
        GltfText g = square();
        g.primitive()["material"] = 0;
        g.doc["materials"] = {{{"name", "paint"}}};
        g.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
        g.doc[Json::json_pointer(place)] = value;
        return g;
    };
    const std::string lamp = "/extensions/KHR_lights_punctual/lights/0/", paint = "/materials/0/";
    struct Case {
        std::string place;
        Json value;
        const char* told;
    };
    const Case refused[] = {
        {lamp + "intensity", "5", "intensity must be a number"},
        {lamp + "intensity", -5, "intensity must be at least 0"},
        {lamp + "color", {1, 1}, "color must be 3 numbers"},
        {lamp + "color", {-1, 1, 1}, "color must be at least 0"},
        {paint + "extensions/KHR_materials_emissive_strength/emissiveStrength", -1,
         "emissiveStrength must be at least 0"},
        {paint + "emissiveFactor", {1, -1, 0}, "material 0 \"paint\": emissiveFactor must be at least 0"},
        {paint + "pbrMetallicRoughness/roughnessFactor", "1", "roughnessFactor must be a number"},
        {paint + "pbrMetallicRoughness/baseColorFactor", {1, 1, 1}, "baseColorFactor must be 4 numbers"},
        {"/cameras/0/perspective/yfov", 0, "camera 0: yfov must be more than 0"},
        {"/cameras/0/perspective/aspectRatio", -1, "aspectRatio must be more than 0"},
        {"/asset/minVersion", "2.1", "needs a reader of glTF \"2.1\""},
    };
    for (const Case& c : refused)
        EXPECT_NE(message(with(c.place.c_str(), c.value)).find(c.told), std::string::npos) << c.told;
    const Case warned[] = {
        {paint + "pbrMetallicRoughness/roughnessFactor", -1, "roughnessFactor should be from 0 to 1"},
        {paint + "pbrMetallicRoughness/metallicFactor", 5, "metallicFactor should be from 0 to 1"},
        {paint + "pbrMetallicRoughness/baseColorFactor", {2, 1, 1, 1}, "baseColorFactor should be from 0 to 1"},
        {"/cameras/0/perspective/yfov", 4, "yfov should be from 0 to 3.1"},
    };
    for (const Case& c : warned) {
        const Scene scene = with(c.place.c_str(), c.value).load();
        const bool is_told = std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const std::string& warning) {
            return warning.find(c.told) != std::string::npos;
        });
        EXPECT_TRUE(is_told) << c.told;
    }
}

TEST(GltfErrors, LampsBeyondAllLampsAreRefused) {
    GltfText g = square();
    Json& lamp = g.doc["extensions"]["KHR_lights_punctual"]["lights"][0];
    lamp["intensity"] = 9e14 / 3;
    EXPECT_EQ(message(g), "");
    lamp["intensity"] = 1.1e15;
    EXPECT_EQ(message(g), "room.gltf: light 0: the intensity is larger than 1e15");
    lamp["intensity"] = 1;
    add_material(g, {{"name", "hot"}, {"emissiveFactor", {1, 1, 1}}});
    g.doc["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1.1e15;
    EXPECT_EQ(message(g), "room.gltf: material 0 \"hot\": the emission is larger than 1e15");
}

/// Names come from strangers and go to terminals and into tables.
TEST(GltfErrors, NamesAreToldInOnePlainLine) {
    GltfText g = square();
    g.doc["meshes"][0]["name"] = "two\nlines";
    g.doc["nodes"][1]["name"] = "red\x1b[31m\r\n";
    const Scene s = g.load();
    EXPECT_EQ(s.light_names, std::vector<std::string>{"red?[31m??"});
    g.primitive()["attributes"].erase("POSITION");
    EXPECT_EQ(message(g), "room.gltf: mesh 0 \"two?lines\": primitive 0 has no POSITION");
    g.doc["extensionsRequired"] = {"EXT_mesh\nlines"};
    EXPECT_EQ(message(g), "room.gltf: requires the extension EXT_mesh?lines, which is not supported");
}

TEST(GltfErrors, VertexColoursOutsideTheirRangeMakeNoLight) {
    GltfText g = square();
    g.floats("COLOR_0", {-1, 2, 0.5f, 1, 1e30f, -1e30f, 0, 1, 0, 0, 0, 0, 1, 1, 1, 7}, "VEC4");
    const Scene s = g.load();
    for (const vec4& c : s.colors)
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << c[i];
}

}  // namespace lw::test
