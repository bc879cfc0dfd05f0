// Photometric files: flux and intensity against their formulas (data/make_photometry.py), symmetries, types, errors,
// and the lamps they make: photons and shadow rays send the same light.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>

#include "base/error_of.h"
#include "base/random.h"
#include "photometry/photometry.h"
#include "scene/gltf.h"
#include "scene/gltf_text.h"
#include "scene/profile.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

Photometry file(const std::string& name) { return read_photometry(LUMENWALK_SOURCE_DIR "/data/photometry/" + name); }

glm::dvec3 direction(double gamma_deg, double c_deg) {
    const double g = gamma_deg * pi / 180, c = c_deg * pi / 180;
    return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

TEST(Photometry, FluxAndIntensityAreThoseOfTheFormulas) {
    const Photometry downlight = file("downlight.ies"), batwing = file("batwing.ies"), flood = file("flood.ies"),
                     washer = file("washer.ldt");
    EXPECT_NEAR(flux_of(downlight) / (2 * pi * 1000 / 9), 1, 0.005);
    EXPECT_NEAR(flux_of(batwing) / (300 * (pi + 3 * pi / 4)), 1, 0.005);
    EXPECT_NEAR(flux_of(washer) / 1200, 1, 0.005);
    EXPECT_NEAR(light_output_ratio(washer), 0.8, 0.005);
    EXPECT_EQ(washer.color_temperature, 3000);
    EXPECT_NEAR(candela_at(downlight, direction(30, 123)), 1000 * std::pow(std::cos(pi / 6), 8), 0.5);
    EXPECT_NEAR(candela_at(downlight, direction(120, 0)), 0, 0);
    for (const double c : {30.0, 150.0, 210.0, 330.0})  // quadrant symmetry
        EXPECT_NEAR(
            candela_at(batwing, direction(40, c)),
            300 * (std::cos(40 * pi / 180) + 3 * std::pow(std::sin(40 * pi / 180), 2) * std::cos(40 * pi / 180) * 0.75),
            0.5);
    for (const double c : {60.0, 300.0})  // symmetric about C0-C180
        EXPECT_NEAR(candela_at(washer, direction(50, c)),
                    1500 * 0.8 / pi * std::cos(50 * pi / 180) * (1 + 0.4 * std::sin(50 * pi / 180)), 0.5);
    EXPECT_GT(candela_at(washer, direction(50, 0)), candela_at(washer, direction(50, 180)));
}

TEST(Photometry, TypeBHasALyingPolarAxisAndTypeAAnUprightOne) {
    const Photometry b = file("flood.ies");
    EXPECT_EQ(b.type, Photometry::Type::B);
    const auto place = [](double h, double v) {  // type B: V about the x axis, then H
        return glm::dvec3(std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v));
    };
    const double h = 40 * pi / 180, v = 30 * pi / 180;
    EXPECT_NEAR(candela_at(b, place(h, v)), 5000 * std::pow(std::cos(h), 6) * std::pow(std::cos(v), 4), 5);
    Photometry a = b;
    a.type = Photometry::Type::A;
    const glm::dvec3 upright(std::cos(v) * std::sin(h), std::sin(v), -std::cos(v) * std::cos(h));
    EXPECT_NEAR(candela_at(a, upright), 5000 * std::pow(std::cos(h), 6) * std::pow(std::cos(v), 4), 5);
    EXPECT_GT(std::abs(candela_at(b, upright) - candela_at(a, upright)), 100);
}

TEST(Photometry, FactorsTiltAndPlanesOfEachEdition) {
    const auto at_zero = [](const std::string& text) { return candela_at(parse_lm63(text, "x.ies"), {0, 0, -1}); };
    EXPECT_EQ(at_zero("old label, 1986\nTILT=NONE\n1 1000 2 3 1 1 1 0 0 0\n0.5 0.9 30\n0 45 90\n0\n100 50 0\n"), 90);
    EXPECT_EQ(at_zero("IESNA91\nTILT=NONE\n1,1000,2,3,1,1,1,0,0,0\n0.5,0.9,30\n0,45,90\n0\n100,50,0\n"), 90);
    EXPECT_EQ(at_zero("IESNA:LM-63-1995\nTILT=NONE\n1 1000 2 3 1 1 1 0 0 0\n0.5 0.9 30\n0 45 90\n0\n100 50 0\n"), 90);
    EXPECT_EQ(at_zero("IESNA:LM-63-2002\nTILT=NONE\n1 1000 2 3 1 1 1 0 0 0\n0.5 0.9 30\n0 45 90\n0\n100 50 0\n"), 100);
    EXPECT_EQ(at_zero("IES:LM-63-2019\nTILT=NONE\n1 1000 2 3 1 1 1 0 0 0\n0.5 1 30\n0 45 90\n0\n100 50 0\n"), 100);
    const Photometry tilted = parse_lm63(
        "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.5\n1 1000 1 3 1 1 1 0 0 0\n1 1 30\n0 45 90\n0\n100 50 0\n", "x");
    EXPECT_NEAR(tilt_factor(tilted, 60), 0.9 - 0.4 / 3, 1e-9);
    const Photometry half = parse_lm63(
        "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 3 3 1 1 0 0 0\n1 1 30\n0 45 90\n90 180 270\n9 1 0 9 2 0 9 3 0\n", "x");
    EXPECT_EQ(candela_at(half, direction(45, 180)), 2);
    EXPECT_NEAR(candela_at(half, direction(45, 0)), 2, 1e-9);
    EXPECT_NEAR(candela_at(half, direction(45, 270)), 3, 1e-9);
    EXPECT_NEAR(candela_at(half, direction(45, 45)), 1.5, 1e-9);
}

TEST(Photometry, EulumdatSymmetriesFold) {
    const auto ldt = [](int symmetry, const std::string& rows) {
        std::string text = "x\n1\n" + std::to_string(symmetry) + "\n4\n90\n2\n90\nr\nn\n0\nf\nd\n";
        for (int i = 0; i < 9; ++i) text += "0\n";
        text += "100\n0\n1\n0\n1\n1\nLED\n1000\n4000\n80\n10\n";
        for (int i = 0; i < 10; ++i) text += "0\n";
        return parse_eulumdat(text + "0\n90\n180\n270\n0\n90\n" + rows, "x.ldt");
    };
    const auto side = [](const Photometry& p, double c) { return candela_at(p, direction(90, c)); };
    const Photometry none = ldt(0, "9\n1\n9\n2\n9\n3\n9\n4\n");
    EXPECT_NEAR(side(none, 270), 4, 1e-9);
    EXPECT_NEAR(side(none, 315), 2.5, 1e-9);
    EXPECT_NEAR(side(ldt(1, "9\n7\n"), 222), 7, 1e-9);
    const Photometry about_c0 = ldt(2, "9\n1\n9\n2\n9\n3\n");
    EXPECT_NEAR(side(about_c0, 270), 2, 1e-9);
    const Photometry about_c90 = ldt(3, "9\n4\n9\n1\n9\n2\n");  // C270, C0, C90
    EXPECT_NEAR(side(about_c90, 180), 1, 1e-9);
    EXPECT_NEAR(side(about_c90, 270), 4, 1e-9);
    EXPECT_NEAR(side(about_c90, 90), 2, 1e-9);
    const Photometry both = ldt(4, "9\n1\n9\n2\n");
    EXPECT_NEAR(side(both, 180), 1, 1e-9);
    EXPECT_NEAR(side(both, 270), 2, 1e-9);
}

TEST(Photometry, MalformedFilesAreRefusedByNameAndLine) {
    const std::string good = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 1 0 0 0\n1 1 30\n0 45 90\n0\n100 50 0\n";
    EXPECT_NO_THROW(parse_photometry(good, "x.ies"));
    for (size_t size = 0; size + 8 < good.size(); ++size) {
        const std::string error = test::error_of([&] { parse_photometry(good.substr(0, size), "x.ies"); });
        EXPECT_EQ(error.rfind("x.ies: ", 0), 0u) << size << ": " << error;
    }
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"0 45 90\n0", "0 45 45\n0", "line 5"},
        {"100 50 0", "100 x 0", "line 7"},
        {"100 50 0", "100 -5 0", "negative"},
        {"1 1000 1 3 1 1", "1 1000 1 3 1 4", "photometric type"},
        {"1 1000 1 3", "1 1000 1 1e9", "whole number"},
        {"TILT=NONE", "TILT=lamp.tlt", "TILT=INCLUDE"},
        {"0 45 90\n0", "-5 45 90\n0", "vertical angles"},
        {"100 50 0", "0 0 0", "gives no light"},
        {"1 1000 1 3", "1 1000 nan 3", "not a number"}};
    for (const auto& [from, to, what] : cases) {
        std::string text = good;
        text.replace(text.find(from), std::string(from).size(), to);
        const std::string error = test::error_of([&] { parse_photometry(text, "x.ies"); });
        EXPECT_NE(error.find(what), std::string::npos) << to << ": " << error;
    }
}

Scene lamp_with(const std::string& name) {
    return with_photometry(test::square().load(), {"bulb=" LUMENWALK_SOURCE_DIR "/data/photometry/" + name});
}

TEST(ProfileLight, PhotonsCarryTheFluxOfTheFileWhereItSendsIt) {
    for (const char* name : {"downlight.ies", "batwing.ies", "flood.ies", "washer.ldt"}) {
        const Scene scene = lamp_with(name);
        const Photometry photometry = file(name);
        const Emitters emitters(scene);
        const float strongest = dot(scene.lights[0].intensity, vec3(0.2126f, 0.7152f, 0.0722f));
        constexpr int count = 200'000, rings = 6, sides = 8;
        double flux = 0, expected_flux = 0;
        std::array<std::array<double, sides>, rings> got{}, expected{};
        for (int i = 0; i < count; ++i) {
            Rng rng(1, 0, uint64_t(i));
            const Emission e = emitters.emit(0, {0, 0, rng.next(), rng.next(), 0});
            const double lumen = double(e.flux.x * strongest) / count;
            flux += lumen;
            const double gamma = std::acos(double(-e.direction.z)),
                         c = std::atan2(double(e.direction.y), double(e.direction.x));
            got[size_t(std::min(gamma / pi * 2 * rings, rings - 1.0))][size_t((c + pi) / (2 * pi) * sides) % sides] +=
                lumen;
        }
        for (int r = 0; r < rings * 30; ++r)
            for (int s = 0; s < sides * 30; ++s) {
                const double gamma = pi / 2 * (r + 0.5) / (rings * 30), c = 2 * pi * (s + 0.5) / (sides * 30) - pi;
                const double area = std::sin(gamma) * (pi / 2 / (rings * 30)) * (2 * pi / (sides * 30));
                const double lumen = area * candela_at(photometry, direction(gamma * 180 / pi, c * 180 / pi));
                expected[size_t(r / 30)][size_t(s / 30)] += lumen;
                expected_flux += lumen;
            }
        EXPECT_NEAR(flux / expected_flux, 1, 0.005) << name;
        EXPECT_NEAR(double(emitters.unit_flux(0) * strongest) / expected_flux, 1, 0.005) << name;
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < sides; ++s) {
                const double sigma = std::sqrt(expected[size_t(r)][size_t(s)] * expected_flux / count);
                EXPECT_NEAR(got[size_t(r)][size_t(s)], expected[size_t(r)][size_t(s)], 5 * sigma + 2e-3 * expected_flux)
                    << name << " " << r << " " << s;
            }
    }
}

TEST(ProfileLight, ShadowRaysSeeTheCandelaOfTheFile) {
    const Scene scene = lamp_with("batwing.ies");
    const Photometry photometry = file("batwing.ies");
    const Emitters emitters(scene);
    for (const vec3 point : {vec3(0, 0, 0), vec3(0.9f, 0.1f, 0), vec3(0.2f, 0.8f, 0)}) {
        const vec3 path = point - scene.lights[0].position;
        const auto in = emitters.arrive(0, point, 0, 0);
        ASSERT_TRUE(in);
        const double candela = double(in->radiance.x * scene.lights[0].intensity.x * dot(path, path));
        EXPECT_NEAR(candela, candela_at(photometry, glm::normalize(glm::dvec3(path))), 0.5);
    }
}

TEST(ProfileLight, NodesOfExtLightsIesAreLamps) {
    test::GltfText g = test::square();
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 1 0 0 0\n1 1 30\n0 45 90\n0\n100 50 0\n";
    test::GltfText::write(text, "lamp.ies");
    g.doc["extensionsUsed"].push_back("EXT_lights_ies");
    g.doc["extensionsRequired"] = {"EXT_lights_ies"};
    g.doc["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "lamp.ies"}}};
    g.doc["nodes"].push_back(
        {{"name", "spot"},
         {"translation", {0, 0, 2}},
         {"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0}}}}}}});
    g.doc["scenes"][0]["nodes"].push_back(2);
    const Scene scene = g.load();
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.light_names[1], "spot");
    EXPECT_EQ(scene.lights[1].type, light_profile);
    EXPECT_NEAR(scene.lights[1].intensity.x, 200, 0.01f);
    EXPECT_NEAR(scene.lights[1].intensity.y, 100, 0.01f);
    EXPECT_EQ(scene.lights[1].direction, vec3(0, 0, -1));
    g.doc["nodes"][2]["extensions"]["EXT_lights_ies"]["light"] = 7;
    EXPECT_NE(test::load_error_of([&] { g.load(); }).find("there is no light profile 7"), std::string::npos);
    g.doc["nodes"][2]["extensions"]["EXT_lights_ies"]["light"] = 0;
    g.doc["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "../lamp.ies"}}};
    EXPECT_NE(test::load_error_of([&] { g.load(); }).find("not inside the folder"), std::string::npos);
}

TEST(ProfileLight, OfANodeThatMakesNoSenseIsRefusedByName) {
    const auto refused = [](const test::Json& profile, const test::Json& reference, double place, const char* named) {
        test::GltfText g = test::square();
        g.doc["extensionsUsed"].push_back("EXT_lights_ies");
        g.doc["extensions"]["EXT_lights_ies"]["lights"] = test::Json::array({profile});
        g.doc["nodes"].push_back({{"translation", {place, 0, 2}}, {"extensions", {{"EXT_lights_ies", reference}}}});
        g.doc["scenes"][0]["nodes"].push_back(2);
        const std::string told = test::load_error_of([&] { g.load(); });
        EXPECT_NE(told.find(named), std::string::npos) << named << ": " << told;
    };
    const test::Json first = {{"light", 0}};
    refused({{"bufferView", 9}}, first, 0, "light profile 0: there is no buffer view 9");
    refused({{"name", "none"}}, first, 0, "light profile 0: has neither uri nor bufferView");
    refused({{"uri", "data:text/plain,IESNA"}}, first, 0, "light profile 0: its data: address is not base64");
    refused({{"uri", "lost.ies"}}, first, 0, "lost.ies: cannot be opened");
    const std::string ies = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 1 0 0 0\n1 1 30\n0 45 90\n0\n100 50 0\n";
    const test::Json good = {{"uri", "data:text/plain;base64," + base64(std::vector<uint8_t>(ies.begin(), ies.end()))}};
    for (const double multiplier : {-1.0, 1e300})
        refused(good, {{"light", 0}, {"multiplier", multiplier}}, 0, "the multiplier of its light profile");
    refused(good, first, 1e30, "node 2: the position is too far away");
}

TEST(ProfileLight, ColourTemperatureTintsAWhiteLampWithoutChangingItsLight) {
    const vec3 warm = color_of_temperature(3000), day = color_of_temperature(6504);
    EXPECT_NEAR(dot(warm, vec3(0.2126f, 0.7152f, 0.0722f)), 1, 1e-5f);
    EXPECT_NEAR(warm.x, 1.77f, 0.03f);  // xy (0.4369, 0.4041) of 3000 K
    EXPECT_NEAR(warm.z, 0.27f, 0.03f);
    EXPECT_LT(length(day - vec3(1)), 0.06f);
    const Scene scene = lamp_with("washer.ldt");
    EXPECT_NEAR(scene.lights[0].intensity.x / scene.lights[0].intensity.z, warm.x / warm.z, 1e-3f);
    EXPECT_NE(summary_of(file("washer.ldt")).find("light output ratio 80 % of 1500 lm, 3000 K"), std::string::npos);
}

TEST(ProfileLight, OnlyPointsAndSpotsTakeAFile) {
    EXPECT_NE(test::error_of([] { lamp_with("none.ies"); }).find("none.ies: cannot be opened"), std::string::npos);
    EXPECT_NE(
        test::error_of([] { with_photometry(test::square().load(), {"sun=x.ies"}); }).find("no lamp of this name"),
        std::string::npos);
}

}  // namespace
}  // namespace lw
