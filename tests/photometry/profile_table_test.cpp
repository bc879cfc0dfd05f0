// Tables of light distributions: as fine as their file needs, in light by rays, in light by photons, and in flux.
#include "scene/profile_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"
#include "scene/gltf_text.h"
#include "scene/profile.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
using Candela = std::function<double(double gamma, double c)>;  // degrees

/// 1 at 0, a half at half the width.
double bell(double angle, double width) { return std::exp2(-4 * angle * angle / (width * width)); }

/// A file of type C with these angles.
Photometry file_of(const std::vector<double>& vertical, const std::vector<double>& horizontal, const Candela& candela) {
    Photometry p;
    p.vertical = vertical;
    p.horizontal = horizontal;
    for (const double c : horizontal)
        for (const double gamma : vertical) p.candela.push_back(candela(gamma, c));
    return p;
}

std::vector<double> steps(double last, double step) {
    std::vector<double> angles;
    for (int i = 0; i * step <= last + 1e-9; ++i) angles.push_back(i * step);
    return angles;
}

/// Fine near the axis, coarse elsewhere, as files of spots are.
std::vector<double> fine_near_zero(double fine, double until) {
    std::vector<double> angles = steps(until, fine);
    for (double angle = std::floor(until) + 1; angle <= 90; ++angle) angles.push_back(angle);
    return angles;
}

struct Case {
    const char* name;
    Photometry photometry;
};

std::vector<Case> cases() {
    const auto beam = [](double width) {
        return [width](double gamma, double) { return 1e5 * bell(gamma, width) + 20 * std::cos(gamma * pi / 180); };
    };
    const Candela lobe = [](double gamma, double c) {
        return 1000 * std::sin(2 * gamma * pi / 180) * bell(c - 200, 3) + 5;
    };
    const Candela oval = [](double gamma, double c) {
        return 1e5 * bell(gamma, 1 + std::pow(std::cos(c * pi / 180), 2)) + 20 * std::cos(gamma * pi / 180);
    };
    Photometry search_light = file_of(fine_near_zero(0.2, 10), fine_near_zero(0.2, 10), [](double v, double h) {
        return 1e6 * bell(h, 2) * bell(v, 1.5) + 100 * std::cos(h * pi / 180) * std::cos(v * pi / 180);
    });
    search_light.type = Photometry::Type::B;
    return {{"beam of 1 degree", file_of(fine_near_zero(0.1, 5), {0}, beam(1))},
            {"beam of 1 degree at odd angles", file_of(fine_near_zero(0.13, 5), {0}, beam(1))},
            {"beam of 4 degrees", file_of(fine_near_zero(0.25, 12), {0}, beam(4))},
            {"oval beam of 1 to 2 degrees", file_of(fine_near_zero(0.1, 8), steps(360, 15), oval)},
            {"lobe of 3 degrees of C", file_of(steps(90, 5), steps(360, 1), lobe)},
            {"lobe and half degrees of C", file_of(steps(90, 2.5), steps(360, 0.5), lobe)},
            {"search light of type B", search_light},
            {"even to the horizon", file_of(steps(90, 5), {0}, [](double, double) { return 100; })},
            {"even to 85 degrees", file_of(steps(85, 5), steps(360, 30), [](double, double) { return 100; })},
            {"even to 140 degrees", file_of(steps(140, 5), {0}, [](double, double) { return 100; })}};
}

Scene lamp_with(const Photometry& photometry) {
    Scene scene = test::square().load();
    scene.lights[0].intensity = vec3(1);
    attach_profile(add_profile(photometry, false, scene), scene.lights[0]);
    return scene;
}

TEST(ProfileTable, FollowsNarrowBeamsAndLobesWithinAPercentOfTheirPeak) {
    for (const Case& c : cases()) {
        const Photometry& p = c.photometry;
        const Scene scene = lamp_with(p);
        const SurfaceReader surfaces(scene);
        const Light& light = scene.lights[0];
        const double peak = *std::max_element(p.candela.begin(), p.candela.end());
        double worst = 0;
        for (size_t h = 0; h < p.horizontal.size(); ++h)
            for (size_t v = 0; v + 1 < p.vertical.size(); ++v)
                for (const double share : {0.0, 0.5}) {
                    const double angle = p.vertical[v] * (1 - share) + p.vertical[v + 1] * share;
                    const glm::dvec3 d = direction_of_angles(p.type, p.horizontal[h], angle);
                    if (d.z > -1e-3 && p.type == Photometry::Type::B) continue;
                    const double got = double(surfaces.profile_value(light, vec3(d)) * light.intensity.x);
                    worst = std::max(worst, std::abs(got - candela_at(p, d)));
                }
        EXPECT_LT(worst / peak, 0.01) << c.name;
        EXPECT_TRUE(profile_table(p).follows) << c.name;
    }
}

TEST(ProfileTable, FluxIsThatOfTheFile) {
    for (const Case& c : cases()) {
        const Scene scene = lamp_with(c.photometry);
        const double flux = flux_of(c.photometry), strongest = double(scene.lights[0].intensity.x);
        const Emitters emitters(scene);
        EXPECT_NEAR(double(emitters.unit_flux(0)) * strongest / flux, 1, 0.003) << c.name;
        constexpr int count = 100'000;
        double sum = 0, squares = 0;
        for (int i = 0; i < count; ++i) {
            Rng rng(1, 0, uint64_t(i));
            const double lumen = double(emitters.emit(0, {0, 0, rng.next(), rng.next(), 0}).flux.x) * strongest;
            sum += lumen / count, squares += lumen * lumen / count;
        }
        const double sigma = std::sqrt(std::max(squares - sum * sum, 0.0) / count);
        EXPECT_NEAR(sum / flux, 1, 0.003 + 4 * sigma / flux) << c.name;
        EXPECT_LT(std::sqrt(std::max(squares - sum * sum, 0.0)) / flux, 1.5) << c.name << ": photons are uneven";
    }
}

/// Flux beyond ten degrees of a beam of one: a hundredth of the whole that sums of single cells could lose.
TEST(ProfileTable, PhotonsCarryTheFaintLightBesideABeamToo) {
    const Candela faint = [](double gamma, double c) {
        return 1e6 * bell(gamma, 1 + 0.5 * std::cos(2 * c * pi / 180)) + 5 * std::cos(gamma * pi / 180);
    };
    const Photometry p = file_of(fine_near_zero(0.05, 5), steps(360, 5), faint);
    const Scene scene = lamp_with(p);
    const Emitters emitters(scene);
    constexpr int count = 400'000;
    double beside = 0;
    for (int i = 0; i < count; ++i) {
        Rng rng(3, 0, uint64_t(i));
        const Emission e = emitters.emit(0, {0, 0, rng.next(), rng.next(), 0});
        if (e.direction.z > -std::cos(10 * lw_pi / 180))
            beside += double(e.flux.x * scene.lights[0].intensity.x) / count;
    }
    const double expected = 5 * pi * std::pow(std::cos(10 * pi / 180), 2);
    EXPECT_NEAR(beside / expected, 1, 4 / std::sqrt(count * expected / flux_of(p)) + 0.003);
}

TEST(ProfileTable, PlainFilesHaveThePlainResolution) {
    for (const char* name : {"downlight.ies", "batwing.ies", "flood.ies", "washer.ldt"}) {
        const ProfileTable table =
            profile_table(read_photometry(LUMENWALK_SOURCE_DIR "/data/photometry/" + std::string(name)));
        EXPECT_EQ(table.columns, std::string(name) == "downlight.ies" ? 1u : 144u) << name;
        EXPECT_EQ(table.rows, 361u) << name;
    }
}

TEST(ProfileTable, ABeamBeyondTheFinestTableIsTold) {
    std::vector<double> angles = steps(0.05, 0.001);
    angles.push_back(90);
    const Candela needle = [](double gamma, double) { return gamma < 0.001 ? 1e6 : 1.0; };
    Photometry p = file_of(angles, {0}, needle);
    p.file = "needle.ies";
    EXPECT_FALSE(profile_table(p).follows);
    EXPECT_LE(profile_table(p).candela.size(), 2'700'000u);
    EXPECT_EQ(lamp_with(p).warnings.back(), "needle.ies: its beam is narrower than the finest table can follow");
    angles = steps(4.5, 0.05);
    angles.push_back(90);
    const Photometry comb = file_of(angles, steps(360, 0.25), [](double gamma, double c) {
        return (std::lround(20 * gamma) + std::lround(4 * c)) % 2 ? 1.0 : 1000.0;
    });
    const ProfileTable largest = profile_table(comb);
    EXPECT_FALSE(largest.follows);
    EXPECT_LE(largest.candela.size(), 2'700'000u);
}

TEST(ProfileTable, LampsOfOneFileShareIt) {
    test::GltfText g = test::square();
    g.doc["nodes"].push_back(g.doc["nodes"][1]);
    g.doc["nodes"][2]["name"] = "other";
    g.doc["scenes"][0]["nodes"].push_back(2);
    const std::string file = LUMENWALK_SOURCE_DIR "/data/photometry/batwing.ies";
    const Scene scene = with_photometry(g.load(), {"bulb=" + file, "other=" + file});
    EXPECT_EQ(scene.lights[0].profile, scene.lights[1].profile);
    EXPECT_EQ(scene.texels.size(), 2u + 144 * 361);
    const Emitters emitters(scene);
    EXPECT_EQ(emitters.unit_flux(0), emitters.unit_flux(1));
}

TEST(ProfileTable, MirroredTableHasTheOtherSideOfC) {
    const Photometry p = file_of(steps(90, 10), steps(360, 10), [](double, double c) { return 100 + c; });
    const ProfileTable plain = profile_table(p), mirrored = profile_table(p, true);
    for (uint column = 1; column < plain.columns; ++column)
        EXPECT_NEAR(mirrored.candela[column * plain.rows + 100],
                    plain.candela[(plain.columns - column) * plain.rows + 100], 1e-6);
}

}  // namespace
}  // namespace lw
