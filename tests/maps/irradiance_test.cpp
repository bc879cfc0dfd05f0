// Irradiance at lattice nodes against closed forms: a ball with a lamp in its middle, and a panel over a floor.
#include "maps/irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/baked_lab.h"

namespace lw {
namespace {

using namespace test;

vec3 irradiance_of(const PhotonMap& map, size_t nodes, uint lamp, uint node) {
    return unpack_rgb9e5(map.irradiance[lamp * nodes + node]) / map.irradiance_scale;
}

TEST(Irradiance, OfABallIsTheSumOfAllReflections) {
    for (float albedo : {0.3f, 0.7f}) {
        LabScene lab;
        lab.add_sphere(vec3(0), 1, 32, albedo);
        lab.add_point(vec3(0), 250);  // its power does not count: irradiance is for one candela
        const BakedLab ball(lab.finish(), {.photons = 200'000, .radius = 0.3f});
        const size_t nodes = ball.map.coverage.size();
        const double expected = double(albedo) / (1 - double(albedo));  // lux; the direct light is left to rays
        std::vector<float> light;
        for (uint node = 0; node < nodes; ++node)
            if (const float e = irradiance_of(ball.map, nodes, 0, node).y; e > 0) light.push_back(e);  // has a point
        ASSERT_GT(light.size(), 100u);
        std::sort(light.begin(), light.end());
        const double median =
            double(light[light.size() / 2]);  // nodes at the rims of patches stray: no pixel weighs them
        EXPECT_NEAR(median / expected, 1, 0.02) << "albedo " << albedo;
    }
}

/// Lux at a point of the floor from a panel of 1 cd/m2 above it that faces down, by 10,000 parts.
double light_of_panel(glm::dvec3 p, glm::dvec3 low, glm::dvec3 high) {
    constexpr int parts = 100;
    double sum = 0;
    for (int i = 0; i < parts; ++i)
        for (int k = 0; k < parts; ++k) {
            const glm::dvec3 q(low.x + (high.x - low.x) * (i + 0.5) / parts, low.y,
                               low.z + (high.z - low.z) * (k + 0.5) / parts);
            const double d2 = glm::dot(q - p, q - p), height = q.y - p.y;
            sum += height * height / (d2 * d2);
        }
    return sum * (high.x - low.x) * (high.z - low.z) / (parts * parts);
}

TEST(Irradiance, OfABlackPanelIsItsProjectedSolidAngle) {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 4), vec3(6, 0, 0), 0.5f);
    lab.add_rectangle("panel", vec3(2, 2.5f, 1), vec3(1.5f, 0, 0), vec3(0, 0, 1), 0.01f, 500);
    const BakedLab room(lab.finish(), {.photons = 20'000, .radius = 0.5f});
    const size_t nodes = room.map.coverage.size();
    size_t count = 0;
    for_each_node(room, [&](const Node& node) {
        if (room.map.grids[node.map].normal.y < 0.9f || node.on_triangle.y > 0.1f) return;
        const double expected = light_of_panel(glm::dvec3(node.on_triangle), {2, 2.5, 1}, {3.5, 2.5, 2});
        EXPECT_NEAR(irradiance_of(room.map, nodes, 0, node.index).y / expected, 1, 0.01)  // the panel reflects a little

            << node.on_triangle.x << " " << node.on_triangle.z;
        ++count;
    });
    EXPECT_GT(count, 50u);
}

}  // namespace
}  // namespace lw
