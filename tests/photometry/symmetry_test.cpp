// Photometric files of every type and symmetry, written from formulas: intensity in all directions and flux against
// the formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "photometry/photometry.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
double radians(double degrees) { return degrees * pi / 180; }

using Candela = std::function<double(double vertical, double horizontal)>;  // degrees

std::string printed(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g ", value);
    return text;
}

/// An LM-63 file every `step` degrees.
Photometry lm63(int type, double low, double high, double first, double last, const Candela& candela, double step = 5) {
    std::string angles, planes, values;
    int verticals = 0, horizontals = 0;
    for (double v = low; v <= high; v += step, ++verticals) angles += printed(v);
    for (double h = first; h <= last; h += step, ++horizontals) {
        planes += printed(h);
        for (double v = low; v <= high; v += step) values += printed(candela(v, h));
        values += "\n";
    }
    return parse_photometry("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 " + std::to_string(verticals) + " " +
                                std::to_string(horizontals) + " " + std::to_string(type) + " 2 0 0 0\n1 1 10\n" +
                                angles + "\n" + planes + "\n" + values,
                            "x.ies");
}

/// A EULUMDAT file of 1000 lm, every 15 degrees of C and 5 of gamma.
Photometry eulumdat(int symmetry, const Candela& candela) {
    std::string text = "x\n1\n" + std::to_string(symmetry) + "\n24\n15\n37\n5\nr\nn\n0\nf\nd\n";
    for (int i = 0; i < 9; ++i) text += "0\n";
    text += "100\n0\n1\n0\n1\n1\nLED\n1000\n4000\n80\n10\n";
    for (int i = 0; i < 10; ++i) text += "0\n";
    for (int c = 0; c < 360; c += 15) text += std::to_string(c) + "\n";
    for (int g = 0; g <= 180; g += 5) text += std::to_string(g) + "\n";
    const std::pair<int, int> given[] = {{0, 345}, {0, 0}, {0, 180}, {-90, 90}, {0, 90}};
    for (int c = given[symmetry].first; c <= given[symmetry].second; c += 15)
        for (int g = 0; g <= 180; g += 5) text += printed(candela(g, c)) + "\n";
    return parse_photometry(text, "x.ldt");
}

glm::dvec3 direction_c(double gamma, double c) {
    const double g = radians(gamma), p = radians(c);
    return {std::sin(g) * std::cos(p), std::sin(g) * std::sin(p), -std::cos(g)};
}

/// The intensities of a lamp over the whole sphere of type C.
void expect_everywhere(const Photometry& photometry, const Candela& candela, double flux, const std::string& what) {
    for (double gamma = 7.5; gamma < 180; gamma += 7.5)  // at the poles all planes meet
        for (double c = 0; c < 360; c += 7.5)
            EXPECT_NEAR(candela_at(photometry, direction_c(gamma, c)), candela(gamma, c), 3)
                << what << " " << gamma << " " << c;
    EXPECT_NEAR(flux_of(photometry) / flux, 1, 0.005) << what;
}

double wide(double gamma) { return 500 + 400 * std::cos(radians(gamma)); }

TEST(Symmetry, TypeCOfLm63) {
    const Candela axial = [](double g, double) { return wide(g); },
                  quarters = [](double g, double c) { return wide(g) * (1 + 0.5 * std::cos(radians(2 * c))); },
                  about_c0 = [](double g, double c) { return wide(g) * (1 + 0.5 * std::cos(radians(c))); },
                  about_c90 = [](double g, double c) { return wide(g) * (1 + 0.5 * std::sin(radians(c))); },
                  none = [](double g, double c) { return wide(g) * (1 + 0.5 * std::cos(radians(c - 30))); };
    const double flux = 4 * pi * 500;
    expect_everywhere(lm63(1, 0, 180, 0, 0, axial), axial, flux, "axial");
    expect_everywhere(lm63(1, 0, 180, 0, 90, quarters), quarters, flux, "0 to 90");
    expect_everywhere(lm63(1, 0, 180, 0, 180, about_c0), about_c0, flux, "0 to 180");
    expect_everywhere(lm63(1, 0, 180, 90, 270, about_c90), about_c90, flux, "90 to 270");
    expect_everywhere(lm63(1, 0, 180, 0, 360, none), none, flux, "0 to 360");
    const Candela down = [](double g, double) { return std::max(900 * std::cos(radians(g)), 0.0); },
                  up = [](double g, double) { return std::max(-900 * std::cos(radians(g)), 0.0); };
    expect_everywhere(lm63(1, 0, 90, 0, 0, down), down, 900 * pi, "lower half");
    expect_everywhere(lm63(1, 90, 180, 0, 0, up), up, 900 * pi, "upper half");
}

TEST(Symmetry, OfEulumdat) {
    const double part = 1000 / (4 * pi);
    const Candela functions[] = {
        [&](double, double c) { return part * (1 + 0.5 * std::cos(radians(c - 30))); },
        [&](double g, double) { return part * (1 + 0.5 * std::cos(radians(g))); },
        [&](double, double c) { return part * (1 + 0.5 * std::cos(radians(c))); },
        [&](double, double c) { return part * (1 + 0.5 * std::sin(radians(c))); },
        [&](double, double c) { return part * (1 + 0.5 * std::cos(radians(2 * c))); },
    };
    for (int symmetry = 0; symmetry <= 4; ++symmetry)
        expect_everywhere(eulumdat(symmetry, functions[symmetry]), functions[symmetry], 1000,
                          "symmetry " + std::to_string(symmetry));
}

/// Types A and B: a polar axis across the aim, and only the half in front.
TEST(Symmetry, TypesAAndB) {
    const Candela even = [](double v, double h) {
        return 800 * std::pow(std::cos(radians(v)), 2) * std::cos(radians(h));
    };
    const Candela lopsided = [](double v, double h) {
        return 400 * std::cos(radians(v)) * std::cos(radians(h)) *
               (2 + std::sin(radians(h)) + 0.5 * std::sin(radians(v)));
    };
    for (const int type : {2, 3}) {
        const auto place = [&](double v, double h) {
            const double a = radians(h), b = radians(v);
            if (type == 3) return glm::dvec3(std::cos(b) * std::sin(a), std::sin(b), -std::cos(b) * std::cos(a));
            return glm::dvec3(std::sin(a), std::cos(a) * std::sin(b), -std::cos(a) * std::cos(b));
        };
        const auto flux = [&](const Candela& candela) {  // the polar angle is v of type A, h of type B
            double sum = 0;
            for (double v = -89.5; v < 90; ++v)
                for (double h = -89.5; h < 90; ++h)
                    sum += candela(v, h) * std::cos(radians(type == 3 ? v : h)) * pow(pi / 180, 2);
            return sum;
        };
        const auto expect_in_front = [&](const Photometry& photometry, const Candela& candela, const char* what) {
            for (double v = -87.5; v < 90; v += 12.5)
                for (double h = -87.5; h < 90; h += 12.5)
                    EXPECT_NEAR(candela_at(photometry, place(v, h)), candela(v, h), 3)
                        << what << " type " << type << " V " << v << " H " << h;
            EXPECT_EQ(candela_at(photometry, {0, 0.1, 0.99}), 0) << what;
            EXPECT_NEAR(flux_of(photometry) / flux(candela), 1, 0.005) << what << " type " << type;
        };
        expect_in_front(lm63(type, 0, 90, 0, 90, even, 2.5), even, "quarter");
        expect_in_front(lm63(type, -90, 90, 0, 90, even, 2.5), even, "right half");
        expect_in_front(lm63(type, 0, 90, -90, 90, even, 2.5), even, "upper half");
        expect_in_front(lm63(type, -90, 90, -90, 90, lopsided, 2.5), lopsided, "whole");
    }
}

TEST(Photometry, EveryFileOfTheFolderHasItsFormulaInTheReadme) {
    std::ifstream stream(LUMENWALK_SOURCE_DIR "/data/README.md");
    const std::string readme((std::istreambuf_iterator<char>(stream)), {});
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LUMENWALK_SOURCE_DIR "/data/photometry")) {
        const std::string name = entry.path().filename();
        EXPECT_NE(readme.find("| `" + name + "` |"), std::string::npos) << name;
        EXPECT_GT(flux_of(read_photometry(entry.path())), 0) << name;
        ++files;
    }
    EXPECT_GE(files, 4u);
}

}  // namespace
}  // namespace lw
