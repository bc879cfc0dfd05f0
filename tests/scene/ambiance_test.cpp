// Ambiance files: what is saved is loaded, what is malformed is refused with file, ambiance and lamp named.
#include "scene/ambiance.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "programs/command.h"
#include "scene/gltf.h"
#include "scene/lamp_factors.h"

namespace lw {
namespace {

std::string refusal_of(const std::string& text) {
    const TempFolder folder;
    const std::string path = folder / "room.ambiances.json";
    write_text(path, text);
    try {
        load_lamp_presets(path);
    } catch (const Error& refusal) {
        EXPECT_NE(std::string(refusal.what()).find("room.ambiances.json"), std::string::npos) << refusal.what();
        EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
        return refusal.what();
    }
    return "";
}

TEST(Ambiance, ComesBackFromItsFileAsItWas) {
    const TempFolder folder;
    LampPresets presets;
    presets.ambiances["Evening \"late\""] = {{"Pendant", {0.4f, vec3(1)}},
                                             {"Lounge / 2", {1.25f, vec3(1, 0.8f, 0.5f)}}};
    presets.ambiances["Off"] = {{"Pendant", {0, vec3(1)}}};
    presets.groups["Ceiling"] = {"Pendant", "Spot"};
    save_lamp_presets(folder / "a.json", presets);
    const LampPresets loaded = load_lamp_presets(folder / "a.json");
    EXPECT_EQ(loaded.ambiances, presets.ambiances);
    EXPECT_EQ(loaded.groups, presets.groups);
}

TEST(Ambiance, IsEmptyWithoutAFile) {
    const TempFolder folder;
    EXPECT_TRUE(load_lamp_presets(folder / "missing.json").ambiances.empty());
}

TEST(Ambiance, RefusesWhatIsMalformedAndNamesIt) {
    const auto refused = [](const std::string& text, const char* named) {
        EXPECT_NE(refusal_of(text).find(named), std::string::npos) << text << ": " << refusal_of(text);
    };
    refused("{", "is not JSON");
    refused("[]", "must be an object with ambiances and groups");
    refused(R"({"ambiances": 3})", "ambiances: must be an object");
    refused(R"({"ambiances": {"Night": [1]}})", "ambiance \"Night\": must be an object of lamps");
    const std::pair<const char*, const char*> lamps[] = {{"-1", "must be from 0 to 1000000"},
                                                         {"1e30", "must be from 0 to 1000000"},
                                                         {"\"half\"", "must be a number"},
                                                         {"null", "must be a number"},
                                                         {R"({"factor": true})", "factor: must be a number"},
                                                         {R"({"color": 1})", "color must be [red, green, blue]"},
                                                         {R"({"color": [1, 1]})", "color must be [red, green, blue]"},
                                                         {R"({"color": [1, -1, 1]})", "color: must be from 0"},
                                                         {R"({"color": [1, "x", 1]})", "color: must be a number"},
                                                         {R"({"kelvin": "warm"})", "kelvin must be a number"},
                                                         {R"({"kelvin": 999})", "kelvin must be from 1000 to 15000"},
                                                         {R"({"kelvin": 1e30})", "kelvin must be from 1000 to 15000"},
                                                         {R"({"colour": [1, 1, 1]})", "unknown entry \"colour\""}};
    for (const auto& [value, told] : lamps)
        refused("{\"ambiances\": {\"Night\": {\"Lamp\": " + std::string(value) + "}}}",
                ("ambiance \"Night\": lamp \"Lamp\": " + std::string(told)).c_str());
    refused(R"({"groups": {"Ceiling": "Lamp"}})", "group \"Ceiling\": must be a list of names of lamps");
    refused(R"({"groups": {"Ceiling": [1]}})", "group \"Ceiling\": must be a list of names of lamps");
    refused(R"({"photometry": {"Lamp": 1}})", "photometry: lamp \"Lamp\": must be the name of a file");
}

TEST(Ambiance, MultipliesThePowersOfItsLampsAndRefusesUnknownOnes) {
    const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/cornell.gltf");
    EXPECT_EQ(lamp_factors(scene, {})[0], vec3(1));
    EXPECT_EQ(lamp_factors(scene, {{"ceiling_lamp", {0.5f, vec3(1, 0.5f, 0)}}})[0], vec3(0.5f, 0.25f, 0));
    EXPECT_THROW(lamp_factors(scene, {{"floor_lamp", {}}}), Error);
}

TEST(Ambiance, DimsThePictureAsPowerDoes) {
    const TempFolder folder;
    const std::string scene = folder / "cornell.gltf";
    std::filesystem::copy_file(LUMENWALK_SOURCE_DIR "/data/cornell.gltf", scene);
    write_text(folder / "cornell.ambiances.json", R"({"ambiances": {"Half": {"ceiling_lamp": 0.5}}})");
    const auto shot = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words{scene, "-o", folder / name, "--size", "8x8", "--samples", "4"};
        words.insert(words.end(), more.begin(), more.end());
        return run("reference", words);
    };
    ASSERT_EQ(shot("a.exr", {"--ambiance", "Half"}).exit_code, 0);
    ASSERT_EQ(shot("b.exr", {"--power", "ceiling_lamp=0.5"}).exit_code, 0);
    ASSERT_EQ(shot("c.exr", {}).exit_code, 0);
    EXPECT_EQ(read_text(folder / "a.exr"), read_text(folder / "b.exr"));
    EXPECT_NE(read_text(folder / "a.exr"), read_text(folder / "c.exr"));
    const Outcome unknown = shot("d.exr", {"--ambiance", "Dawn"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_NE(unknown.err.find("there are: Half"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace lw
