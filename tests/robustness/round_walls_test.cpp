// Round walls on a floor that goes on below them: how much light of one side is on the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "maps/estimate.h"
#include "robustness/room.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};

/// A thin round wall from the floor to the ceiling of a house of 8 x 3 x 5 m, or a dome on its floor.
struct Shell {
    const char* name;
    double radius;
    int facets, rows;
    bool dome;
};

void PrintTo(const Shell& shell, std::ostream* out) { *out << shell.name; }

const Shell shells[] = {{"tower_of_24_facets", 1, 24, 1, false},
                        {"tower_of_96_facets", 1, 96, 8, false},
                        {"tower_of_400_facets", 1, 400, 100, false},
                        {"column_of_64_facets", 0.4, 64, 16, false},
                        {"dome_of_128_facets", 1, 128, 48, true}};
const glm::dvec3 middle(5.3, 0, 2.5);

Soup soup_of(const Shell& shell) {
    const auto at = [&](double i, double j) {
        const double turn = 2 * M_PI * i / shell.facets, rise = j / shell.rows;
        const glm::dvec3 out(std::cos(turn), 0, std::sin(turn));
        if (!shell.dome) return middle + out * shell.radius + glm::dvec3(0, 3 * rise, 0);
        const double lean = rise * M_PI / 2;
        return middle + (out * std::cos(lean) + glm::dvec3(0, std::sin(lean), 0)) * shell.radius;
    };
    Soup soup;
    for (int i = 0; i < shell.facets; ++i)
        for (int j = 0; j < shell.rows; ++j) {
            soup.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            soup.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return soup;
}

Room room_of(const Shell& shell, bool lamp_inside) {
    Room room = plain_room();
    room.walls = joined(box({0, 0, 0}, {8, 3, 5}, true), soup_of(shell));
    room.block.clear(), room.panel.clear();
    room.panel_luminance = 0;
    room.double_sided = true;
    room.lamp = lamp_inside ? middle + glm::dvec3(0, 0.7, 0) : glm::dvec3(2, 2, 2.5);
    return room;
}

/// Mean of lux(place) on the floor `distance` m inside (negative: outside) of the wall.
template <class Lux>
double mean_beside(const Shell& shell, double distance, const Lux& lux) {
    constexpr int places = 200;
    // The middles of facets lie within the circle.
    const double r = (shell.radius - distance) * (distance > 0 ? std::cos(M_PI / shell.facets) : 1);
    double sum = 0;
    for (int i = 0; i < places; ++i) {
        const double turn = 2 * M_PI * (i + 0.37) / places;
        sum += lux(middle + glm::dvec3(std::cos(turn), 0, std::sin(turn)) * r) / places;
    }
    return sum;
}

double lux_on_floor(const Baked& baked, const PhotonEstimator& estimator, glm::dvec3 place) {
    const glm::dvec3 above = place + glm::dvec3(0, 1e-3, 0) - baked.scene.origin;
    const std::optional<Hit> hit = baked.caster.nearest(vec3(above), vec3(0, -1, 0));
    if (!hit) return -1;
    const vec3 lux = estimator.estimate(hit->triangle, hit->barycentrics, vec3(0, 1, 0)).irradiance;
    return double(luminance(lux));
}

std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

class RoundWalls : public testing::TestWithParam<Shell> {};
INSTANTIATE_TEST_SUITE_P(Robustness, RoundWalls, testing::ValuesIn(shells),
                         [](const auto& s) { return std::string(s.param.name); });

TEST_P(RoundWalls, KeepLightOnTheirSide) {
    const Shell& shell = GetParam();
    for (const bool lamp_inside : {false, true}) {
        const Baked baked(room_of(shell, lamp_inside), 200'000, 1, true);
        const std::vector<vec3> weights = lamp_powers(baked.scene, {});
        double max_near = 0, most = 0;
        for (uint mode : modes) {
            const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 0});
            const auto lux = [&](glm::dvec3 place) { return lux_on_floor(baked, estimator, place); };
            for (double distance : {0.01, 0.03, 0.08, 0.2}) {
                const double inside = mean_beside(shell, distance, lux), outside = mean_beside(shell, -distance, lux);
                const double share = lamp_inside ? outside / inside : inside / outside;
                (distance < 0.02 ? max_near : most) = std::max(distance < 0.02 ? max_near : most, share);
            }
        }
        tell_case("floor behind a " + words_of(shell.name) + (lamp_inside ? ", lamp inside" : ", lamp outside"),
                  "at 1 cm <= 3 %, from 3 cm on <= 0.5 % of before it", "%.2f %%, %.2f %%", 100 * max_near, 100 * most);
        EXPECT_LE(max_near, 0.03) << lamp_inside;
        EXPECT_LE(most, 0.005) << lamp_inside;
    }
}

TEST_P(RoundWalls, TakeNoLightFromTheFloorBesideThem) {
    const Shell& shell = GetParam();
    if (shell.dome) return;  // too low for a lamp whose light falls evenly
    Room room = room_of(shell, true);
    room.albedo = 0;  // what lands is known: I cos / d2
    room.lamp = middle + glm::dvec3(0, 2.5, 0);
    const Baked baked(room, 400'000, 1, true);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    for (uint mode : {gather_mode_cached, gather_mode_smooth}) {
        const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 100, 0});
        double sum = 0, expected = 0;
        for (double distance : {0.01, 0.03, 0.06, 0.1}) {
            sum += mean_beside(shell, distance, [&](glm::dvec3 p) { return lux_on_floor(baked, estimator, p); });
            expected += mean_beside(shell, distance, [&](glm::dvec3 p) {
                const glm::dvec3 way = room.lamp - p;
                return room.candela * way.y / std::pow(glm::length(way), 3);
            });
        }
        tell_case("floor within 10 cm inside a " + words_of(shell.name) +
                      (mode == gather_mode_cached ? ", cached" : ", smooth"),
                  "I cos / d2, +-9 %", "bias %+.2f %%", 100 * (sum / expected - 1));
        EXPECT_NEAR(sum / expected, 1, 0.09) << mode;
    }
}

}  // namespace
}  // namespace lw::test
