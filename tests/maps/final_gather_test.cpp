// Final gathering at lattice nodes against closed forms: a bright spot that rays hardly meet, a mirror, and what lies
// under something.
#include "maps/final_gather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps/baked_lab.h"
#include "photons/shoot.h"

namespace lw {
namespace {

using namespace test;

/// Lux for one candela at a node of a map, of its only lamp.
float lux_at(const PhotonMap& map, uint node) { return unpack_rgb9e5(map.irradiance[node]).y / map.irradiance_scale; }

/// A square of 6 cm, 2 cm below a lamp, is all that reflects; the ceiling 2 m above it is black.
struct BrightSpot {
    static constexpr double side = 0.06, gap = 0.02, height = 2, albedo = 0.8;
    static constexpr int parts = 60;  // along the side, of the sums below

    static Scene scene() {
        LabScene lab;
        lab.add_rectangle("ceiling", vec3(-1, height, -1), vec3(2, 0, 0), vec3(0, 0, 2), 0);
        lab.add_rectangle("spot", vec3(-side / 2, 0, -side / 2), vec3(0, 0, side), vec3(side, 0, 0), float(albedo));
        lab.add_point(vec3(0, gap, 0), 300);
        return lab.finish();
    }

    /// Lux at a point of the ceiling for one candela: the square as a sum of small Lambert sources.
    static double expected(vec3 at) {
        double sum = 0;
        for (int i = 0; i < parts; ++i)
            for (int k = 0; k < parts; ++k) {
                const double x = side * ((i + 0.5) / parts - 0.5), z = side * ((k + 0.5) / parts - 0.5);
                const double from_lamp2 = x * x + z * z + gap * gap;
                const double dx = double(at.x) - x, dz = double(at.z) - z, d2 = dx * dx + dz * dz + height * height;
                sum += gap / (from_lamp2 * std::sqrt(from_lamp2)) * height * height / (d2 * d2);
            }
        return sum * albedo / double(lw_pi) * side * side / (parts * parts);
    }
};

TEST(FinalGather, LeavesASmallBrightSpotToThePhotonsItReflects) {
    const BakedLab lab(BrightSpot::scene(), {.photons = 100'000, .radius = 0.3f});
    double sum = 0, worst = 0;
    size_t count = 0;
    for_each_node(lab, [&](const Node& node) {
        if (lab.map.grids[node.map].normal.y > -0.9f || std::abs(node.on_triangle.x) > 0.6f ||
            std::abs(node.on_triangle.z) > 0.6f)
            return;
        const double ratio = double(lux_at(lab.map, node.index)) / BrightSpot::expected(node.on_triangle);
        sum += ratio, ++count;
        worst = std::max(worst, std::abs(ratio - 1));
    });
    ASSERT_GT(count, 20u);
    EXPECT_NEAR(sum / double(count), 1, 0.03);  // the kernel blurs the falloff by 1.5 %
    EXPECT_LT(worst, 0.15);  // one ray in 3,500 meets the square: 64 of them would be right by a factor of 50, or zero
}

TEST(FinalGather, IsEvenInABall) {
    for (float albedo : {0.3f, 0.7f}) {
        LabScene lab;
        lab.add_sphere(vec3(0), 1, 32, albedo);
        lab.add_point(vec3(0), 250);
        const BakedLab ball(lab.finish(), {.photons = 200'000, .radius = 0.3f});
        const double expected = double(albedo) / (1 - double(albedo));  // all reflections, for one candela
        double squares = 0, count = 0;
        for (uint node = 0; node < ball.map.coverage.size(); ++node)
            if (const double e = double(lux_at(ball.map, node)); e > 0)
                squares += (e / expected - 1) * (e / expected - 1), ++count;
        EXPECT_GT(count, 100);
        EXPECT_LT(std::sqrt(squares / count), 0.05) << "albedo " << albedo;
    }
}

TEST(FinalGather, GivesNodesUnderARugTheLightBesideIt) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(4, 3, 4), 0.5f);
    lab.add_rectangle("rug", vec3(1, 0.01f, 1), vec3(0, 0, 2), vec3(2, 0, 0), 0.5f);
    lab.add_rectangle("below", vec3(1, 0.01f, 1), vec3(2, 0, 0), vec3(0, 0, 2), 0.5f);
    lab.add_point(vec3(2, 2, 2), 250);
    const BakedLab room(lab.finish(), {.photons = 100'000, .radius = 0.3f});
    double beside = 0, beside_count = 0;
    const auto distance_to_rug = [](vec3 p) {
        return std::max(std::abs(p.x - 2), std::abs(p.z - 2)) - 1;  // negative under it
    };
    const auto on_floor = [&](const Node& node) {
        return room.map.grids[node.map].normal.y > 0.9f && std::abs(node.on_triangle.y) < 1e-3f;
    };
    for_each_node(room, [&](const Node& node) {
        const float d = distance_to_rug(node.on_triangle);
        if (on_floor(node) && d > 0.1f && d < 0.5f) beside += double(lux_at(room.map, node.index)), ++beside_count;
    });
    beside /= beside_count;
    size_t under = 0;
    for_each_node(room, [&](const Node& node) {  // the first nodes under its border: a pixel beside it weighs them
        const float d = distance_to_rug(node.on_triangle);
        if (!on_floor(node) || d > -0.02f || d < -0.14f) return;
        EXPECT_NEAR(double(lux_at(room.map, node.index)) / beside, 1, 0.25) << node.on_triangle.x;
        ++under;
    });
    EXPECT_GT(under, 10u);
}

TEST(FinalGather, PhotonsKnowWhereTheyWereReflected) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(4, 3, 5), 0.6f);
    lab.add_point(vec3(2, 2, 2), 250);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 2000});
    for (const Photon& p : photons.records) {
        ASSERT_NE(p.reflector_side, no_reflector);  // direct light is not stored
        const vec3 way = p.reflector - p.position;
        EXPECT_LT(length(way - length(way) * p.from), 1e-4f);  // m
        const auto [a, b, c] = triangle_corners(scene, p.reflector_side / 2);
        EXPECT_LT(length(closest_point_on_triangle(p.reflector, a, b, c) - p.reflector), 1e-4f);
        EXPECT_EQ(p.reflector_side % 2, 0u);  // the room is seen from its front
    }
}

}  // namespace
}  // namespace lw
