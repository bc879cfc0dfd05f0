// Numbers and names of a file that make no sense: refused, bounded or told.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/gltf_text.h"

namespace lw::test {

TEST(GltfValues, FactorsBeyondTheFloatsAreRefusedOrBounded) {
    GltfText g = square();
    g.primitive()["material"] = 0;
    const auto material = [&](const Json& m) {
        g.doc["materials"] = Json::array({m});
        return refusal_of(g);
    };
    EXPECT_NE(material({{"emissiveFactor", {1e300, 0, 0}}}).find("the emission is not finite"), std::string::npos);
    EXPECT_NE(material({{"normalTexture", {{"index", 0}, {"scale", 1e300}}}}), "");
    const Json specular = {{"KHR_materials_specular", {{"specularColorFactor", {1e300, 1, 1}}}}};
    EXPECT_NE(material({{"extensions", specular}}).find("a factor is not finite"), std::string::npos);
    EXPECT_EQ(material({{"pbrMetallicRoughness", {{"roughnessFactor", 1e300}}}}), "");
    GltfText bright = square();
    bright.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 1e300;
    EXPECT_NE(refusal_of(bright).find("the intensity is not finite"), std::string::npos);
    GltfText camera = square();
    camera.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1e300}, {"aspectRatio", 1e-300}}}}};
    camera.doc["cameras"][0]["perspective"]["znear"] = 1e-300;
    camera.node()["camera"] = 0;
    const Scene s = camera.load();
    EXPECT_GT(s.cameras[0].near, 0);
    EXPECT_GE(s.cameras[0].aspect, 1e-3f);
    camera.doc["nodes"].push_back({{"camera", 0}, {"translation", {1e20, 0, 0}}});
    camera.doc["scenes"][0]["nodes"].push_back(2);
    EXPECT_NE(refusal_of(camera).find("the camera is too far away"), std::string::npos) << refusal_of(camera);
}

TEST(GltfValues, NumbersOfTheWrongTypeOrSignAreTold) {
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
        EXPECT_NE(refusal_of(with(c.place.c_str(), c.value)).find(c.told), std::string::npos) << c.told;
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

TEST(GltfValues, LampsBeyondAllLampsAreRefused) {
    GltfText g = square();
    Json& lamp = g.doc["extensions"]["KHR_lights_punctual"]["lights"][0];
    lamp["intensity"] = 9e14 / 3;
    EXPECT_EQ(refusal_of(g), "");
    lamp["intensity"] = 1.1e15;
    EXPECT_EQ(refusal_of(g), "room.gltf: light 0: the intensity is larger than 1e15");
    lamp["intensity"] = 1;
    add_material(g, {{"name", "hot"}, {"emissiveFactor", {1, 1, 1}}});
    g.doc["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1.1e15;
    EXPECT_EQ(refusal_of(g), "room.gltf: material 0 \"hot\": the emission is larger than 1e15");
}

/// Names come from strangers and go to terminals and into tables.
TEST(GltfValues, NamesAreToldInOnePlainLine) {
    GltfText g = square();
    g.doc["meshes"][0]["name"] = "two\nlines";
    g.doc["nodes"][1]["name"] = "red\x1b[31m\r\n";
    const Scene s = g.load();
    EXPECT_EQ(s.light_names, std::vector<std::string>{"red?[31m??"});
    g.primitive()["attributes"].erase("POSITION");
    EXPECT_EQ(refusal_of(g), "room.gltf: mesh 0 \"two?lines\": primitive 0 has no POSITION");
    g.doc["extensionsRequired"] = {"EXT_mesh\nlines"};
    EXPECT_EQ(refusal_of(g), "room.gltf: requires the extension EXT_mesh?lines, which is not supported");
}

TEST(GltfValues, VertexColoursOutsideTheirRangeMakeNoLight) {
    GltfText g = square();
    g.floats("COLOR_0", {-1, 2, 0.5f, 1, 1e30f, -1e30f, 0, 1, 0, 0, 0, 0, 1, 1, 1, 7}, "VEC4");
    const Scene s = g.load();
    for (const vec4& c : s.colors)
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << c[i];
}

}  // namespace lw::test
