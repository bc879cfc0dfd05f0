// Which grids belong to plane patches, and where the nodes of their lattices lie.
#include "maps/plane_grids.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "maps/baked_lab.h"

namespace lw {
namespace {

using namespace test;

const BakeSettings settings{.photons = 20'000, .radius = 0.4f};

Scene box_with(float albedo) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(3, 2.5f, 4), albedo);
    lab.add_point(vec3(1.5f, 2, 2), 100);
    return lab.finish();
}

TEST(PlaneGrids, AreThoseOfFlatWallsAndNotThoseOfABall) {
    const BakedLab box(box_with(0.5f), settings);
    const PlaneGrids flat(box.scene, box.map);
    ASSERT_EQ(box.map.grids.size(), 12u);
    for (size_t m = 0; m < box.map.grids.size(); ++m) EXPECT_TRUE(flat.is_plane(m) && flat.is_matte_plane(m)) << m;

    LabScene lab;
    lab.add_sphere(vec3(0), 1.5f, 24, 0.5f);
    lab.add_point(vec3(0), 100);
    const BakedLab ball(lab.finish(), settings);
    const PlaneGrids round(ball.scene, ball.map);
    std::vector<size_t> triangles(ball.map.grids.size(), 0);
    for (uint g : ball.map.grid_of_side)
        if (g != no_grid) ++triangles[g];
    size_t bent = 0;
    for (size_t m = 0; m < ball.map.grids.size(); ++m) {
        if (triangles[m] < 3) continue;  // one or two may lie in a plane
        EXPECT_FALSE(round.is_plane(m)) << m;
        ++bent;
    }
    EXPECT_GT(bent, 20u);
}

TEST(PlaneGrids, AreNotMatteWhereTheyShineOrTheirNormalsBend) {
    const auto matte_planes = [](const auto& change) {
        Scene scene = box_with(0.5f);
        change(scene);
        const BakedLab box(std::move(scene), settings);
        const PlaneGrids planes(box.scene, box.map);
        size_t count = 0;
        for (size_t m = 0; m < box.map.grids.size(); ++m) {
            EXPECT_TRUE(planes.is_plane(m)) << m;
            count += planes.is_matte_plane(m);
        }
        return count;
    };
    EXPECT_EQ(matte_planes([](Scene&) {}), 12u);
    EXPECT_EQ(matte_planes([](Scene& s) { s.materials[0].metallic = 0.5f; }), 10u);  // the floor
    EXPECT_EQ(matte_planes([](Scene& s) { s.materials[0].specular = 1, s.materials[0].roughness = 0.2f; }), 10u);
    EXPECT_EQ(matte_planes([](Scene& s) { s.normals[0] = normalize(s.normals[0] + vec3(0.1f, 0, 0.1f)); }), 11u);
}

TEST(PlaneGrids, PointsOnTheirLatticesLieOnTheSurface) {
    const BakedLab box(box_with(0.5f), settings);
    const PlaneGrids planes(box.scene, box.map);
    for (size_t m = 0; m < box.map.grids.size(); ++m) {
        const SurfaceGrid& grid = box.map.grids[m];
        const vec3 p = point_on_lattice(grid, vec2(0.5f, 1.5f), planes.height(m));
        const vec3 to_wall = min(abs(p), abs(vec3(3, 2.5f, 4) - p));
        EXPECT_LT(std::min({to_wall.x, to_wall.y, to_wall.z}), 1e-4f);
        const vec3 step = point_on_lattice(grid, vec2(1.5f, 1.5f), planes.height(m)) - p;
        EXPECT_LT(length(step - grid.u_axis * grid.lattice.step.x), 1e-5f);
    }
}

}  // namespace
}  // namespace lw
