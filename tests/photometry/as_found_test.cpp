// Photometric files as they are found, not quite as their standards have them: read right and told, or refused.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"
#include "photometry/lamp_color.h"
#include "photometry/photometry.h"
#include "programs/command.h"
#include "scene/gltf_text.h"
#include "scene/profile.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

/// An absolute LM-63 file with its parts in their order.
struct Lm63 {
    std::string label = "IESNA:LM-63-2002", tilt = "TILT=NONE", lamps = "1 -1", factors = "1 1 20";
    std::string vertical = "0 30 60 90", horizontal = "0", candela = "1000 800 400 0", end = "\n";
    int verticals = 4, horizontals = 1;

    std::string text() const {
        return label + "\n[TEST] T1\n[MANUFAC] me\n" + tilt + "\n" + lamps + " 1 " + std::to_string(verticals) + " " +
               std::to_string(horizontals) + " 1 2 0.1 0.1 0\n" + factors + "\n" + vertical + "\n" + horizontal + "\n" +
               candela + end;
    }
    Photometry photometry() const { return parse_photometry(text(), "l.ies"); }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::string utf16(const std::string& text, bool big_endian) {
    std::string bytes = big_endian ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    return bytes;
}

glm::dvec3 direction(double gamma, double c) { return direction_of_angles(Photometry::Type::C, c, gamma); }

std::string notes_of(const Photometry& photometry) {
    std::string notes;
    for (const std::string& note : photometry.notes) notes += note + "\n";
    return notes;
}

TEST(FilesAsFound, LineEndsAndEncodingsOfAnySystem) {
    const std::string ldt = read_text(LUMENWALK_SOURCE_DIR "/data/photometry/washer.ldt");
    for (const auto& [name, text] :
         {std::pair<std::string, std::string>{"l.ies", Lm63().text()}, {"l.ldt", replaced(ldt, "\r\n", "\n")}}) {
        const Photometry expected = parse_photometry(text, name);
        for (const std::string& bytes :
             {replaced(text, "\n", "\r"), replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r\r\n"),
              "\xef\xbb\xbf" + text, utf16(text, false), utf16(text, true), utf16(replaced(text, "\n", "\r"), true)}) {
            const Photometry found = parse_photometry(bytes, name);
            EXPECT_EQ(found.candela, expected.candela) << name;
            EXPECT_EQ(found.color_temperature, expected.color_temperature) << name;
            EXPECT_TRUE(found.notes.empty()) << notes_of(found);
        }
    }
    EXPECT_NE(test::error_of([] { parse_photometry(replaced(Lm63().text(), "400 0", "x 0"), "l.ies"); }).find("line 9"),
              std::string::npos);
    EXPECT_NE(test::error_of([] {
                  parse_photometry(replaced(replaced(Lm63().text(), "400 0", "x 0"), "\n", "\r"), "l.ies");
              }).find("line 9"),
              std::string::npos);
}

TEST(FilesAsFound, LabelsHoweverTheyAreSpelledTellWhatTheThirdFactorIs) {
    for (const char* label : {"IESNA:LM-63-2019", "IES:LM-63-2019", "IES: LM-63-2019", "ies:lm-63-2019", "IES LM-63-19",
                              "ANSI/IES LM-63-19", "IESNA:LM-63-2002", " IESNA : LM-63-2002 ",
                              "\xef\xbb\xbfIESNA:LM-63-2019", "\nIESNA:LM-63-2019", "IESNA LM63-02"})
        EXPECT_EQ(candela_at(Lm63{.label = label, .factors = "1 1.10000 20"}.photometry(), {0, 0, -1}), 1000) << label;
    for (const char* label : {"IESNA:LM-63-1995", "IESNA91", "IESNA86", "iesna:lm-63-95", "a lamp of 2019", ""})
        EXPECT_NEAR(candela_at(Lm63{.label = label, .factors = "1 1.10000 20"}.photometry(), {0, 0, -1}), 1100, 1e-9)
            << label;
}

TEST(FilesAsFound, DecimalCommasAreRead) {
    const Photometry p = Lm63{.candela = "1000,5 800,5 400,5 0,0"}.photometry();
    EXPECT_EQ(candela_at(p, {0, 0, -1}), 1000.5);
    EXPECT_NEAR(candela_at(p, direction(30, 77)), 800.5, 1e-9);
    EXPECT_NE(notes_of(p).find("l.ies: its commas are read as decimal points"), std::string::npos) << notes_of(p);
    const Photometry all =
        Lm63{.factors = "1,0 1,0 20,5", .vertical = "0,0 22,5 60,0 90,0", .candela = "1000,5, 800,5, 400,5, 0,0"}
            .photometry();
    EXPECT_NEAR(candela_at(all, direction(22.5, 0)), 800.5, 1e-9);
    const Lm63 separated{.vertical = "0,30,60,90", .candela = "1000,800, 400,0"};
    EXPECT_TRUE(separated.photometry().notes.empty());
    // Thousands separated: neither reading has as many numbers as there should be.
    EXPECT_NE(test::error_of([] { Lm63{.candela = "1,000.5 800.5 400.5 0.5"}.photometry(); }).find("left over"),
              std::string::npos);
}

TEST(FilesAsFound, WhatIsLeftOverAfterTheLastIntensityIsTold) {
    EXPECT_EQ(notes_of(Lm63{.end = "\n 7 8\n9\n"}.photometry()),
              "l.ies: line 10: \"7\" and 2 more are left over after the last intensity\n");
    EXPECT_EQ(notes_of(Lm63{.end = " \n\n\x1a"}.photometry()), "");
    const std::string ldt = read_text(LUMENWALK_SOURCE_DIR "/data/photometry/washer.ldt");
    EXPECT_NE(notes_of(parse_photometry(ldt + "17\r\n", "l.ldt")).find("\"17\" is left over"), std::string::npos);
}

/// A file with planes from `first`, `count` of them every `step` degrees, of 500 + 300 cos(C - 40) cd at all angles.
Photometry around(double first, double step, int count) {
    Lm63 file{.horizontal = "", .candela = ""};
    file.horizontals = count;
    for (int i = 0; i < count; ++i) {
        const double c = first + i * step;
        file.horizontal += std::to_string(c) + " ";
        for (int v = 0; v < 4; ++v) file.candela += std::to_string(500 + 300 * std::cos((c - 40) * pi / 180)) + " ";
    }
    return file.photometry();
}

TEST(FilesAsFound, PlanesGoAroundTheCircleFromAnywhere) {
    for (const Photometry& p : {around(0, 15, 24), around(0, 15, 25), around(-180, 15, 25), around(-180, 15, 24),
                                around(7.5, 15, 24), around(15, 15, 24), around(-90, 15, 25), around(0, 90, 4)}) {
        const double step = p.horizontal[1] - p.horizontal[0];
        for (double c = 0; c < 360; c += 2.5)
            EXPECT_NEAR(candela_at(p, direction(50, c)), 500 + 300 * std::cos((c - 40) * pi / 180), step > 15 ? 100 : 3)
                << p.horizontal[0] << " " << c;
        EXPECT_NEAR(flux_of(p), 2 * pi * 500, 0.01) << p.horizontal[0];
        EXPECT_TRUE(p.notes.empty()) << notes_of(p);
    }
    for (const auto& [first, count] : {std::pair{0.0, 20}, {30.0, 7}, {15.0, 1}})
        EXPECT_NE(test::error_of([&] { around(first, 15, count); }).find("horizontal angles of type C"),
                  std::string::npos)
            << first;
}

TEST(FilesAsFound, AnglesThatEndEarlyOrStartLateGiveNothingElsewhere) {
    for (const auto& [low, high] : {std::pair{0.0, 85.0}, {0.0, 140.0}, {5.0, 90.0}, {95.0, 180.0}}) {
        Lm63 file{.vertical = "", .candela = "100 100 100 100"};
        for (int i = 0; i < 4; ++i) file.vertical += std::to_string(low + i * (high - low) / 3) + " ";
        const Photometry p = file.photometry();
        EXPECT_NEAR(flux_of(p), 2 * pi * 100 * (std::cos(low * pi / 180) - std::cos(high * pi / 180)), 1e-3);
        EXPECT_NEAR(candela_at(p, direction((low + high) / 2, 10)), 100, 1e-9);
        EXPECT_EQ(candela_at(p, direction(high < 180 ? high + 1 : low - 1, 10)), 0);
        EXPECT_NE(notes_of(p).find("degrees only; 0 is taken elsewhere"), std::string::npos) << notes_of(p);
    }
    for (const char* vertical : {"-5 30 60 90", "0 30 60 190"})
        EXPECT_NE(test::error_of([&] { Lm63{.vertical = vertical}.photometry(); }).find("vertical angles of type C"),
                  std::string::npos);
}

TEST(FilesAsFound, TiltInAnyCaseAndSpacing) {
    for (const char* tilt : {"tilt=none", "TILT = NONE", "Tilt=None", "  TILT=NONE  ", "TILT\t=\tNone"})
        EXPECT_EQ(candela_at(Lm63{.tilt = tilt}.photometry(), {0, 0, -1}), 1000) << tilt;
    for (const char* tilt : {"tilt=include", "TILT = Include"})
        EXPECT_EQ(tilt_factor(Lm63{.tilt = std::string(tilt) + "\n1\n3\n0 45 90\n1 0.9 0.5"}.photometry(), 45), 0.9);
    EXPECT_NE(test::error_of([] { Lm63{.tilt = "TILT NONE"}.photometry(); }).find("before TILT="), std::string::npos);
}

TEST(FilesAsFound, ATiltFileIsReadFromTheFolderOfTheFile) {
    const TempFolder folder;
    write_text(folder / "Lamp.TLT", "1\r3\r0 45 90\r1 0.9 0.5\r");
    for (const char* tilt : {"TILT=Lamp.TLT", "tilt = lamp.tlt", "TILT=C:\\PHOTO\\LAMP.TLT", "TILT=../../lamp.tlt"}) {
        write_text(folder / "l.ies", Lm63{.tilt = tilt}.text());
        const Photometry p = read_photometry(folder / "l.ies");
        EXPECT_NEAR(tilt_factor(p, 45), 0.9, 1e-12) << tilt;
        EXPECT_EQ(p.tilt_file.filename(), "Lamp.TLT");
    }
    const auto refused = [&] { return test::error_of([&] { read_photometry(folder / "l.ies"); }); };
    write_text(folder / "Lamp.TLT", "1\n3\n0 45 40\n1 0.9 0.5\n");
    EXPECT_EQ(refused(), "l.ies: Lamp.TLT: line 3: the tilt angles must rise");
    for (const char* tilt : {"TILT=other.tlt", "TILT=..", "TILT=", "TILT=/"}) {
        write_text(folder / "l.ies", Lm63{.tilt = tilt}.text());
        EXPECT_NE(refused().find("there is no such file beside this one"), std::string::npos) << refused();
    }
}

TEST(FilesAsFound, NegativeIntensitiesThatAreNoiseAreToldAndZero) {
    const Photometry p = Lm63{.candela = "1000 800 400 -0.01"}.photometry();
    EXPECT_EQ(candela_at(p, direction(90, 0)), 0);
    EXPECT_EQ(notes_of(p), "l.ies: negative intensities, the lowest of them -0.01, are taken as 0\n");
    const std::string ldt = read_text(LUMENWALK_SOURCE_DIR "/data/photometry/washer.ldt");
    const Photometry washer = parse_photometry(replaced(ldt, "\n0.000\r\n", "\n-0.01\r\n"), "w.ldt");
    EXPECT_EQ(notes_of(washer), "w.ldt: negative intensities, the lowest of them -0.01, are taken as 0\n");
    EXPECT_EQ(test::error_of([] { Lm63{.candela = "1000 800 -4 0"}.photometry(); }),
              "l.ies: the intensity at plane 0, angle 60 is negative (-4)");
}

TEST(FilesAsFound, NoLampsAndAbsoluteOnesAreRead) {
    for (const char* lamps : {"0 -1", "0 1000", "1 -1", "1 0"}) {
        const Photometry p = Lm63{.lamps = lamps}.photometry();
        EXPECT_EQ(candela_at(p, {0, 0, -1}), 1000) << lamps;
        EXPECT_EQ(light_output_ratio(p), 0) << lamps;
    }
}

TEST(FilesAsFound, ColoursOfLampsAsCataloguesWriteThem) {
    const std::pair<const char*, double> colors[] = {{"3000", 3000},
                                                     {"3000 K", 3000},
                                                     {"2700K", 2700},
                                                     {"830", 3000},
                                                     {"840/4000K", 4000},
                                                     {"930", 3000},
                                                     {"827", 2700},
                                                     {"865", 6500},
                                                     {"LED 840", 4000},
                                                     {"L36W/840", 4000},
                                                     {"TL5 965", 6500},
                                                     {"ww", 3000},
                                                     {"WW/80", 3000},
                                                     {"warmweiss", 3000},
                                                     {"Neutral white", 4000},
                                                     {"nw", 4000},
                                                     {"tw", 6500},
                                                     {"Tageslichtweiss", 6500},
                                                     {"cool white", 6500},
                                                     {"6500.0", 6500},
                                                     {"", 0},
                                                     {"80", 0},
                                                     {"white", 0},
                                                     {"RGB", 0},
                                                     {"0", 0},
                                                     {"99999999999999999999999", 0}};
    for (const auto& [text, kelvin] : colors) EXPECT_EQ(temperature_of(text), kelvin) << text;
    const std::string ldt = read_text(LUMENWALK_SOURCE_DIR "/data/photometry/washer.ldt");
    EXPECT_EQ(parse_photometry(replaced(ldt, "\n3000 K\r\n", "\n840/4000K\r\n"), "l.ldt").color_temperature, 4000);
}

/// Lux from the first lamp, which looks down, on a floor 2 m below it, at a place beside its foot.
double lux_below(const Scene& scene, vec3 place) {
    const auto in = Emitters(scene).arrive(0, scene.lights[0].position - vec3(0, 2, 0) + place, 0, 0);
    return in ? double(in->radiance.x * scene.lights[0].intensity.x * in->to_light.y) : 0;
}

/// The lamp's node turned by -90 degrees about x, so that it aims down, under a node with this scale.
test::GltfText hanging_lamp(const std::vector<double>& scale) {
    test::GltfText g = test::square();
    const double half = std::sqrt(0.5);
    g.doc["nodes"][1]["translation"] = {0, 2, 0};
    g.doc["nodes"][1]["rotation"] = {-half, 0, 0, half};
    g.doc["nodes"].push_back({{"scale", scale}, {"children", {1}}});
    g.doc["scenes"][0]["nodes"] = {0, 2};
    return g;
}

TEST(FilesAsFound, LightOnTheFloorIsThatOfTheFile) {
    const TempFolder folder;
    const auto lux = [&](const Lm63& file, vec3 point) {
        write_text(folder / "l.ies", file.text());
        return lux_below(with_photometry(hanging_lamp({1, 1, 1}).load(), {"bulb=" + folder / "l.ies"}), point);
    };
    const vec3 at_30(2 * std::tan(lw_pi / 6), 0, 0);
    EXPECT_NEAR(lux({.label = "IESNA:LM-63-2019", .factors = "1 1.10000 20"}, vec3(0)), 250, 0.01);
    const Lm63 commas{.candela = "1000,5 800,5 400,5 0,0"};
    EXPECT_NEAR(lux(commas, at_30), 129.98, 0.01);
    EXPECT_NEAR(lux(commas, -at_30), 129.98, 0.01);
    EXPECT_EQ(with_photometry(hanging_lamp({1, 1, 1}).load(), {"bulb=" + folder / "l.ies"}).warnings.back(),
              "l.ies: its commas are read as decimal points");
}

/// 800 cd at 30 degrees towards C90, none towards C270; 50 and 400 beside.
const Lm63 to_one_side{.horizontal = "0 90 180 270 360",
                       .candela = "1000 100 50 0 1000 800 400 0 1000 100 50 0 1000 0 0 0 1000 100 50 0",
                       .horizontals = 5};

TEST(FilesAsFound, NodesThatMirrorHaveTheMirroredDistribution) {
    const TempFolder folder;
    write_text(folder / "l.ies", to_one_side.text());
    const vec3 c90(0, 0, -2 * std::tan(lw_pi / 6));
    const double bright = 800 * std::cos(pi / 6) / (4 + 4.0 / 3);  // 129.9 lx
    const std::pair<std::vector<double>, bool> scales[] = {
        {{1, 1, 1}, true}, {{-1, 1, 1}, true}, {{1, 1, -1}, false}, {{-1, 1, -1}, false}, {{3, 2, 0.5}, true}};
    for (const auto& [scale, towards_minus_z] : scales) {
        test::GltfText g = hanging_lamp(scale);
        const Scene by_option = with_photometry(g.load(), {"bulb=" + folder / "l.ies"});
        const std::string text = to_one_side.text();
        g.doc["extensionsUsed"].push_back("EXT_lights_ies");
        g.doc["extensions"]["EXT_lights_ies"]["lights"] = {
            {{"uri", "data:text/plain;base64," + base64(std::vector<uint8_t>(text.begin(), text.end()))}}};
        g.doc["nodes"][1]["extensions"] = {{"EXT_lights_ies", {{"light", 0}}}};
        for (const Scene& scene : {by_option, g.load()}) {
            EXPECT_NEAR(lux_below(scene, c90), towards_minus_z ? bright : 0, 0.02) << scale[0] << " " << scale[2];
            EXPECT_NEAR(lux_below(scene, -c90), towards_minus_z ? 0 : bright, 0.02) << scale[0] << " " << scale[2];
        }
    }
}

TEST(FilesAsFound, ATiltFileIsNotWrittenOver) {
    const TempFolder folder;
    write_text(folder / "lamp.tlt", "1\n3\n0 45 90\n1 0.9 0.5\n");
    write_text(folder / "l.ies", Lm63{.tilt = "TILT=lamp.tlt"}.text());
    const Scene scene = with_photometry(hanging_lamp({1, 1, 1}).load(), {"bulb=" + folder / "l.ies"});
    EXPECT_NE(std::find(scene.files.begin(), scene.files.end(), std::filesystem::path(folder / "lamp.tlt")),
              scene.files.end());
}

}  // namespace
}  // namespace lw
