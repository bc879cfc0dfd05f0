// The lattices over the walls of a room: how far apart their nodes are, and the coverage of each.
#include "maps/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/photons_on_floor.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.4f;  // m

/// The lattices over the upper side of a floor under the sky, whose photons lie on one of its two triangles.
struct LaidFloor {
    explicit LaidFloor(const std::vector<vec3>& above) {
        std::vector<Photon> photons;
        for (vec3 from : above) photons.push_back(*photon_below(caster, from, 0));
        lattice =
            lay_lattice(scene, caster, partition, sort_into_grids({scene, caster, partition, photons}, {}).surfaces);
    }
    /// Calls visit(place on the floor, node) for all nodes that are over a triangle.
    template <class Visit>
    void for_each_node(const Visit& visit) const {
        for (const SurfaceGrid& grid : lattice.surfaces.grids)
            for (uint y = 0; y < grid.lattice.rows; ++y)
                for (uint x = 0; x < grid.lattice.columns; ++x) {
                    const vec2 uv = grid.lattice.low + vec2(float(x), float(y)) * grid.lattice.step;
                    visit(position_of(grid, vec3(uv, 0)), grid.lattice.first_node + y * grid.lattice.columns + x);
                }
    }

    Scene scene = floor_with_two_lamps();
    RayCaster caster{scene};
    Partition partition = partition_surfaces(scene, caster, {.radius = radius});
    Lattice lattice;
};

TEST(Lattice, HasANodeEveryHalfOfItsScale) {
    const LaidFloor floor({vec3(1, 1, 5), vec3(5, 1, 1)});
    ASSERT_EQ(floor.lattice.surfaces.grids.size(), 2u);
    size_t nodes = 0;
    for (const SurfaceGrid& grid : floor.lattice.surfaces.grids) {
        EXPECT_EQ(grid.lattice.first_node, nodes);
        // The longest side, the diagonal of 8.49 m, lies along u, so the box is 4.24 m deep.
        EXPECT_EQ(grid.lattice.columns, 44u);
        EXPECT_EQ(grid.lattice.rows, 23u);
        EXPECT_NEAR(grid.lattice.step.x, 6 * std::sqrt(2.0) / 43, 1e-5);
        EXPECT_NEAR(grid.lattice.step.y, 3 * std::sqrt(2.0) / 22, 1e-5);
        nodes += grid.lattice.columns * grid.lattice.rows;
    }
    EXPECT_EQ(floor.lattice.nodes.size(), nodes);
    EXPECT_EQ(floor.lattice.coverage.size(), nodes);
}

TEST(Lattice, NodesLieWhereTheirPlaceInTheLatticeSays) {
    const LaidFloor floor({vec3(1, 1, 5), vec3(5, 1, 1)});
    size_t over = 0;
    floor.for_each_node([&](vec3 place, uint n) {
        const NodePoint& node = floor.lattice.nodes[n];
        if (!node.exists() || node.distance2 > 0) return;
        const uvec3 c = floor.scene.triangles[node.triangle];
        const vec3 a = floor.scene.positions[c.x], b = floor.scene.positions[c.y], d = floor.scene.positions[c.z];
        const vec3 point = a + (b - a) * node.barycentrics.x + (d - a) * node.barycentrics.y;
        EXPECT_LT(length(point - place), 0.021f * length(floor.lattice.surfaces.grids[0].lattice.step));  // drawn in
        ++over;
    });
    size_t expected = 0;  // of both halves, whose corner opposite to the diagonal lies above the middle of it
    for (double y = 0; y <= 22; ++y) expected += 2 * size_t(std::floor(43 * (1 - y / 44)) - std::ceil(43 * y / 44) + 1);
    EXPECT_EQ(over, expected);
}

/// The part of a kernel of radius 1 on one side of a line at a signed distance from its centre, in strips along it.
double part_before(double distance) {
    constexpr int strips = 1000;
    double sum = 0;
    for (int i = 0; i < strips; ++i) {
        const double t = -1 + (std::min(distance, 1.0) + 1) * (i + 0.5) / strips;
        sum += 8 / (3 * M_PI) * std::pow(1 - t * t, 1.5) * (std::min(distance, 1.0) + 1) / strips;
    }
    return sum;
}

TEST(Lattice, NodesKeepTheCoverageOfTheirSurroundings) {
    const LaidFloor floor({vec3(1, 1, 5), vec3(5, 1, 1)});
    size_t inside = 0, at_edge = 0;
    floor.for_each_node([&](vec3 p, uint n) {
        if (!floor.lattice.nodes[n].exists() || floor.lattice.nodes[n].distance2 > 0) return;
        const float to_edge = std::min({p.x, p.z, 6 - p.x, 6 - p.z});
        const float to_next = std::max(std::min(p.x, 6 - p.x), std::min(p.z, 6 - p.z));
        if (to_next < radius) return;  // in a corner
        for (const float part : {0.25f, 0.5f, 0.75f, 1.0f})
            EXPECT_NEAR(unpack_coverage(floor.lattice.coverage[n], part),
                        part_before(double(to_edge / (part * radius))), 0.01)
                << p.x << " " << p.z;
        ++(to_edge > radius ? inside : at_edge);
    });
    EXPECT_GT(inside, 500u);
    EXPECT_GT(at_edge, 100u);
}

TEST(Lattice, IsLaidOverPatchesWithPhotonsAlone) {
    const LaidFloor floor({vec3(1, 1, 5)});
    ASSERT_EQ(floor.lattice.surfaces.grids.size(), 1u);
    EXPECT_EQ(floor.lattice.nodes.size(), 44u * 23u);
    size_t points = 0;
    for (const NodePoint& node : floor.lattice.nodes) {
        if (!node.exists()) continue;
        EXPECT_EQ(node.triangle, 0u);
        ++points;
    }
    EXPECT_GT(points, 500u);
    EXPECT_LT(points, 600u);  // the triangle fills half of its box
}

}  // namespace
}  // namespace lw
