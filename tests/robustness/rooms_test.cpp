// The same room written down in hard ways has the same light: mean within 1 %, RMSE within twice the noise of two
// seeds, or 4.5 % where light is gathered at nodes. Prints the rows of the table in docs/robustness.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "maps/build.h"
#include "maps/estimate.h"
#include "robustness/disguises.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};
constexpr const char* mode_names[] = {"exact", "smooth", "cached"};

/// The plain room's readings of two seeds: what is expected, and the noise.
struct Expected {
    Readings readings;
    double noise;
};

const Expected& expected(uint mode) {
    static const std::map<uint, Expected> all = [] {
        const Room room = plain_room();
        const Baked first(room), second(room, 200'000, 2);
        std::map<uint, Expected> found;
        for (uint m : modes) {
            const Readings readings = read(first, room, m);
            found[m] = {readings, difference(readings, read(second, room, m)).rmse};
        }
        return found;
    }();
    return all.at(mode);
}

class Robustness : public testing::TestWithParam<Disguise> {};

INSTANTIATE_TEST_SUITE_P(Rooms, Robustness, testing::ValuesIn(disguises),
                         [](const auto& disguise) { return std::string(disguise.param.name); });

TEST_P(Robustness, TheRoomHasTheSameLight) {
    const Room room = GetParam().room();
    const Baked baked(room);
    for (uint mode : modes) {
        const Readings readings = read(baked, room, mode);
        for (double lux : readings.lux) ASSERT_TRUE(std::isfinite(lux));
        const Difference d = difference(expected(mode).readings, readings, GetParam().scale);
        char wanted[64];
        // Seeds of final gathering differ by less than 1 %, lattices that lie otherwise by more.
        const double allowed = std::max(2 * expected(mode).noise, mode == gather_mode_cached ? 0.045 : 0.0);
        std::snprintf(wanted, sizeof wanted, "RMSE <= %.1f %%, bias <= 1 %%", 100 * allowed);
        tell_case(words_of(GetParam().name) + ", " + mode_names[mode], wanted, "RMSE %.1f %%, bias %+.2f %%",
                  100 * d.rmse, 100 * (d.mean_ratio - 1));
        EXPECT_GT(d.compared, 550u) << mode_names[mode];
        EXPECT_NEAR(d.mean_ratio, 1, 0.01) << mode_names[mode];
        EXPECT_LE(d.rmse, allowed) << mode_names[mode];
    }
}

TEST(RobustnessOfNodes, AShearedNodeIsTheShearOfItsVertices) {
    glm::dmat4 shear(1);
    shear[1][0] = 0.4, shear[2][1] = -0.3, shear[0][0] = -1;  // mirrored too
    const auto move = [&](glm::dvec3 p) { return glm::dvec3(shear * glm::dvec4(p, 1)); };
    const Room by_node = with_node(shear);
    Room by_vertices = plain_room();
    for (Soup* soup : {&by_vertices.walls, &by_vertices.block, &by_vertices.panel}) {
        *soup = moved(*soup, move);
        for (Corners& t : *soup) std::swap(t[1], t[2]);  // what the mirror turned over
    }
    by_vertices.lamp = move(by_vertices.lamp), by_vertices.eye = move(by_vertices.eye);
    const Baked a(by_node), b(by_vertices);
    ASSERT_EQ(a.scene.triangles.size(), b.scene.triangles.size());
    const double areas[] = {area_of(a.scene), area_of(b.scene)};
    EXPECT_NEAR(areas[0] / areas[1], 1, 1e-5);
    double sums[2] = {0, 0};
    for (const Photon& p : a.photons.records) sums[0] += double(p.flux.y);
    for (const Photon& p : b.photons.records) sums[1] += double(p.flux.y);
    tell_case("sheared and mirrored by its node", "flux of its vertices sheared, +-1 %", "%+.2f %%",
              100 * (sums[0] / sums[1] - 1));
    EXPECT_NEAR(sums[0] / sums[1], 1, 0.01);
    for (uint mode : modes) {  // by_node's rays, in the room that both are
        const Difference d = difference(read(a, by_node, mode), read(b, by_node, mode));
        EXPECT_GT(d.compared, 550u) << mode_names[mode];
        EXPECT_NEAR(d.mean_ratio, 1, 0.01) << mode_names[mode];
        EXPECT_LE(d.rmse, 2 * expected(mode).noise) << mode_names[mode];
    }
    EXPECT_NEAR(double(length(a.scene.lights[0].position - b.scene.lights[0].position)), 0, 1e-4);
    for (size_t v = 0; v < a.scene.positions.size(); ++v)
        ASSERT_NEAR(double(std::abs(dot(a.scene.normals[v], a.scene.normals[v]))), 1, 1e-4);
    for (uint t = 0; t < a.scene.triangles.size(); ++t) {
        const SurfaceReader first(a.scene), second(b.scene);
        EXPECT_GT(
            dot(first.surface_at(t, vec2(0.3f)).geometric_normal, second.surface_at(t, vec2(0.3f)).geometric_normal),
            0.999f)
            << t;
    }
}

}  // namespace
}  // namespace lw::test
