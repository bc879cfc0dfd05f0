// Walls that stand on a floor that goes on below them: no light of one side on the other, right up to the wall, and
// none lost beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gather/renderer.h"
#include "maps/estimate.h"
#include "programs/lavapipe.h"
#include "robustness/room.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};
constexpr double distances[] = {0.002, 0.01, 0.03, 0.08, 0.2};  // m from a wall

/// A house of 8 x 3 x 5 m with one floor, one ceiling and one wall all around, parted in two.
struct House {
    const char* name;
    Soup (*part)();
    int pieces;         // each triangle in so many squared
    glm::dvec3 foot;    // a point at the foot of the wall, on its lit side
    glm::dvec3 across;  // unit, horizontal, from the lit side to the dark one
    double thickness;
};

void PrintTo(const House& house, std::ostream* out) { *out << house.name; }

Soup sheet() { return quad({4, 0, 0}, {0, 0, 5}, {0, 3, 0}); }
Soup millimetre() { return box({4, 0, 0}, {4.001, 3, 5}, false); }
Soup decimetre() { return box({4, 0, 0}, {4.1, 3, 5}, false); }
Soup diagonal() { return quad({3, 0, 0}, {2, 0, 5}, {0, 3, 0}); }
Soup slab() { return box({0, 1.4, 0}, {8, 1.401, 5}, false); }

const House houses[] = {
    {"a_sheet", sheet, 1, {4, 0, 2.2}, {1, 0, 0}, 0},
    {"a_wall_of_a_millimetre", millimetre, 1, {4, 0, 2.2}, {1, 0, 0}, 0.001},
    {"a_wall_of_a_decimetre", decimetre, 1, {4, 0, 2.2}, {1, 0, 0}, 0.1},
    {"a_wall_of_small_triangles", millimetre, 40, {4, 0, 2.2}, {1, 0, 0}, 0.001},
    {"a_diagonal_sheet", diagonal, 1, {3.88, 0, 2.2}, {5 / std::sqrt(29.0), 0, -2 / std::sqrt(29.0)}, 0},
    {"a_diagonal_sheet_of_small_triangles",
     diagonal,
     30,
     {3.88, 0, 2.2},
     {5 / std::sqrt(29.0), 0, -2 / std::sqrt(29.0)},
     0},
};

Room room_of(const House& house) {
    Room room = plain_room();
    room.walls = divided(joined(box({0, 0, 0}, {8, 3, 5}, true), house.part()), house.pieces);
    room.block.clear(), room.panel.clear();
    room.panel_luminance = 0;
    room.double_sided = true;
    room.lamp = {2, 2, 2.5};
    return room;
}

/// Illuminance where a ray from `from` meets a surface, from that side.
double lux_at(const Baked& baked, const PhotonEstimator& estimator, glm::dvec3 from, glm::dvec3 direction) {
    const std::optional<Hit> hit = baked.caster.nearest(vec3(from - baked.scene.origin), vec3(direction));
    if (!hit) return -1;
    const vec3 lux = estimator.estimate(hit->triangle, hit->barycentrics, vec3(-direction)).irradiance;
    return double(luminance(lux));
}

std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

class Walls : public testing::TestWithParam<House> {};
INSTANTIATE_TEST_SUITE_P(Robustness, Walls, testing::ValuesIn(houses),
                         [](const auto& h) { return std::string(h.param.name); });

TEST_P(Walls, KeepAllLightOnTheirSide) {
    const House& house = GetParam();
    for (const uint64_t photons : {5'000, 200'000}) {
        const Baked baked(room_of(house), photons, 1, true);
        const std::vector<vec3> weights = lamp_powers(baked.scene, {});
        const glm::dvec3 along(-house.across.z, 0, house.across.x);
        double most = 0;
        for (uint mode : modes) {
            const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 0});
            double lit = 0;
            for (double distance : distances)
                for (double s = -2; s <= 2; s += 0.19) {
                    const glm::dvec3 foot = house.foot + along * s;
                    const glm::dvec3 here = foot - house.across * distance;
                    const glm::dvec3 there = foot + house.across * (house.thickness + distance);
                    for (double up : {-1.0, 1.0}) {  // floor and ceiling
                        lit += lux_at(baked, estimator, here + glm::dvec3(0, 1.5, 0), {0, up, 0});
                        const double dark = lux_at(baked, estimator, there + glm::dvec3(0, 1.5, 0), {0, up, 0});
                        most = std::max(most, dark);
                        EXPECT_EQ(dark, 0)
                            << photons << " photons, mode " << mode << ", " << distance << " m, " << s << " " << up;
                    }
                }
            if (mode == gather_mode_exact)
                tell_case("floor and ceiling 2 mm to 20 cm behind " + words_of(house.name) + ", " +
                              std::to_string(photons) + " photons, all modes",
                          "0 lx", "%.3g lx at most", most);
            EXPECT_GT(lit, 100) << mode;
            for (double height : {0.05, 1.5, 2.9}) {  // the wall beside it, the same quad on both sides
                const glm::dvec3 there = house.foot + house.across * (house.thickness + 0.01);
                EXPECT_EQ(lux_at(baked, estimator, there + glm::dvec3(0, height, 0), along), 0) << mode;
                EXPECT_EQ(lux_at(baked, estimator, there + glm::dvec3(0, height, 0), -along), 0) << mode;
            }
        }
    }
}

TEST_P(Walls, TakeNoLightFromTheFloorBesideThem) {
    const House& house = GetParam();
    Room room = room_of(house);
    room.albedo = 0;  // what lands is known: I cos / d2
    const Baked baked(room, 400'000, 1, true);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const glm::dvec3 along(-house.across.z, 0, house.across.x);
    for (uint mode : {gather_mode_cached, gather_mode_smooth}) {
        const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 100, 0});
        double sum = 0, expected = 0;
        for (double distance : {0.004, 0.01, 0.03, 0.06, 0.1})
            for (double s = -1; s <= 1; s += 0.02) {
                const glm::dvec3 here = house.foot + along * s - house.across * distance;
                const glm::dvec3 way = room.lamp - here;
                sum += lux_at(baked, estimator, here + glm::dvec3(0, 1.5, 0), {0, -1, 0});
                expected += room.candela * way.y / std::pow(glm::length(way), 3);
            }
        tell_case(
            "floor within 10 cm of " + words_of(house.name) + (mode == gather_mode_cached ? ", cached" : ", smooth"),
            "I cos / d2, +-6 %", "bias %+.2f %%", 100 * (sum / expected - 1));
        EXPECT_NEAR(sum / expected, 1, 0.06) << mode;  // as beside any border: 0 to +6 %
    }
}

TEST(Storeys, KeepTheirLightAlongTheWallThatGoesThroughBoth) {
    const House house{"a_slab", slab, 1, {}, {}, 0.001};
    Room room = room_of(house);
    room.lamp = {2, 0.9, 2.5};
    const Baked baked(room, 200'000, 1, true);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    for (uint mode : modes) {
        const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 0});
        for (double distance : distances)
            for (double z = 0.3; z < 4.8; z += 0.3) {
                EXPECT_GT(lux_at(baked, estimator, {1, 1.4 - distance, z}, {-1, 0, 0}), 0) << mode << " " << distance;
                EXPECT_EQ(lux_at(baked, estimator, {1, 1.401 + distance, z}, {-1, 0, 0}), 0) << mode << " " << distance;
            }
    }
}

TEST(Walls, WithADoorLetLightThroughItOnly) {
    Room room = room_of(houses[0]);
    Soup wall = joined(quad({4, 0, 0}, {0, 0, 2}, {0, 3, 0}), quad({4, 0, 3}, {0, 0, 2}, {0, 3, 0}));
    room.walls = joined(box({0, 0, 0}, {8, 3, 5}, true), wall);
    room.albedo = 0;
    const Baked baked(room, 400'000, 1, true);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const PhotonEstimator estimator(baked.scene, baked.map, weights, {gather_mode_smooth, 100, 0});
    double sum = 0, expected = 0;
    for (double x = 3.7; x < 4.31; x += 0.01)
        for (double z = 2.35; z < 2.66; z += 0.05) {  // on the way through the door
            const glm::dvec3 here(x, 0, z), way = room.lamp - here;
            sum += lux_at(baked, estimator, here + glm::dvec3(0, 1.5, 0), {0, -1, 0});
            expected += room.candela * way.y / std::pow(glm::length(way), 3);
        }
    EXPECT_NEAR(sum / expected, 1, 0.03);
    for (double distance : distances)
        for (double z : {0.5, 1.0, 4.0, 4.5})
            EXPECT_EQ(lux_at(baked, estimator, {4 + distance, 1.5, z}, {0, -1, 0}), 0) << distance;
}

TEST(WallsOnADevice, KeepAllLightOnTheirSide) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    Room room = room_of(houses[1]);
    room.eye = {6, 2.5, 4};
    const Baked baked(room, 100'000, 1, true);
    const Bvh bvh = build_bvh(baked.scene);
    const Resident resident(device, baked.scene, baked.map, bvh);
    Renderer renderer(device, resident, 48, 36);
    Camera camera = baked.scene.cameras[0];
    camera.yfov = 1.9f;
    for (const double yaw : {0.0, 1.57, 3.14, 4.71}) {
        const vec3 back = normalize(vec3(float(std::sin(yaw)), 0.4f, float(std::cos(yaw))));
        const vec3 right = normalize(cross(vec3(0, 1, 0), back));
        camera.rotation = mat3(right, cross(back, right), back);
        for (uint mode : modes) {
            RenderSettings settings;
            settings.gather.mode = mode;
            settings.gather.neighbours = 200;
            const Image image = renderer.render(camera, settings).image;
            for (float v : image.find("illuminance")->values) ASSERT_EQ(v, 0) << yaw << " mode " << mode;
        }
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lw::test
