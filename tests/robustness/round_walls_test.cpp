// Round walls on a floor that goes on below them: how much light of one side is on the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// Mean illuminance of the floor `distance` m inside (negative: outside) of the wall.
double lux_beside(const Baked& baked, const PhotonEstimator& estimator, const Shell& shell, double distance) {
    double sum = 0;
    constexpr int places = 200;
    for (int i = 0; i < places; ++i) {
        const double turn = 2 * M_PI * (i + 0.37) / places;
        // Chords of facets lie within the circle.
        const double r = (shell.radius - distance) * (distance > 0 ? std::cos(M_PI / shell.facets) : 1);
        const glm::dvec3 above = middle + glm::dvec3(std::cos(turn), 0, std::sin(turn)) * r + glm::dvec3(0, 1e-3, 0);
        const std::optional<Hit> hit = baked.caster.nearest(vec3(above - baked.scene.origin), vec3(0, -1, 0));
        if (!hit) continue;
        const vec3 lux = estimator.estimate(hit->triangle, hit->barycentrics, vec3(0, 1, 0)).irradiance;
        sum += double(dot(lux, vec3(0.2126f, 0.7152f, 0.0722f))) / places;
    }
    return sum;
}

class RoundWalls : public testing::TestWithParam<Shell> {};
INSTANTIATE_TEST_SUITE_P(Robustness, RoundWalls, testing::ValuesIn(shells),
                         [](const auto& s) { return std::string(s.param.name); });

TEST_P(RoundWalls, KeepLightOnTheirSide) {
    for (const bool lamp_inside : {false, true}) {
        const Baked baked(room_of(GetParam(), lamp_inside), 200'000, 1, true);
        const std::vector<vec3> weights = light_weights(baked.scene, {});
        std::printf("%s lamp %d radius %.3f grids %zu refs %zu/%zu\n", GetParam().name, lamp_inside,
                    double(baked.map.settings.radius), baked.map.grids.size(), baked.map.places.size(),
                    baked.photons.records.size());
        for (uint mode : modes) {
            const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 0});
            const double side = lamp_inside ? -1 : 1;
            for (double d : {0.002, 0.005, 0.01, 0.03, 0.08, 0.2})
                std::printf("  mode %u %.3f m: dark %.4f lit %.3f\n", mode, d,
                            lux_beside(baked, estimator, GetParam(), d * side),
                            lux_beside(baked, estimator, GetParam(), -d * side));
        }
    }
}

}  // namespace
}  // namespace lw::test
