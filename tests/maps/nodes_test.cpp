// The nodes of lattices: close enough to each other, over all of the surface, each with its nearest point.
#include "maps/nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "benchmark/lab_scene.h"
#include "benchmark/rooms.h"
#include "scene/triangle.h"

namespace lw {
namespace {

/// The patches of a scene, a grid with the frame of each, and the nodes laid over them.
struct Laid {
    Laid(Scene made, float patch_size, float step)
        : scene(std::move(made)),
          patches(group_triangles(scene, patch_size)),
          shapes(shapes_of(scene, patches)),
          laid(lay_nodes(scene, partition(step), grids())),
          grids_of_patches(laid.surfaces.grids),
          nodes(laid.points) {}

    Partition partition(float step) const {
        const std::vector<float> radii(patches.count, 1.0f);
        return {.patches = patches,
                .shapes = shapes,
                .scales = radii,
                .node_distances = std::vector<float>(patches.count, step),
                .neighbour_angle_deg = 60,
                .radii = radii,
                .neighbours = Neighbours(shapes, radii, 60, std::vector<float>(patches.count, 100))};
    }
    PatchGrids grids() const {
        PatchGrids surfaces;
        surfaces.grid_of_side = patches.of_side;
        for (uint p = 0; p < patches.count; ++p) {
            SurfaceGrid& grid = surfaces.grids.emplace_back();
            grid.u_axis = shapes[p].u_axis, grid.v_axis = shapes[p].v_axis, grid.normal = shapes[p].normal;
            grid.origin = shapes[p].anchor + shapes[p].u_axis * 0.1f;  // not the anchor itself
            grid.columns = grid.rows = 1;
            surfaces.patches.push_back(p);
        }
        return surfaces;
    }
    vec3 position_of(const NodePoint& node) const {
        const uvec3 c = scene.triangles[node.triangle];
        const vec2 b = node.barycentrics;
        return scene.positions[c.x] * (1 - b.x - b.y) + scene.positions[c.y] * b.x + scene.positions[c.z] * b.y;
    }
    static vec3 in_grid(const SurfaceGrid& grid, vec3 p) {
        p -= grid.origin;
        return {dot(p, grid.u_axis), dot(p, grid.v_axis), dot(p, grid.normal)};
    }

    Scene scene;
    Patches patches;
    std::vector<PatchShape> shapes;
    Nodes laid;
    const std::vector<SurfaceGrid>& grids_of_patches;
    const std::vector<NodePoint>& nodes;
};

constexpr float spacing = 0.3f;

const Laid& furnished_room() {
    static const Laid laid(make_room({10'000, 2}), 1.5f, spacing);
    return laid;
}

template <class Visit>
void for_each_place(const Laid& laid, const Visit& visit) {
    for (size_t m = 0; m < laid.grids_of_patches.size(); ++m) {
        const SurfaceLattice& lattice = laid.grids_of_patches[m].lattice;
        for (uint i = 0; i < lattice.columns * lattice.rows; ++i)
            visit(laid.grids_of_patches[m], m,
                  lattice.low + vec2(float(i % lattice.columns), float(i / lattice.columns)) * lattice.step,
                  laid.nodes[lattice.first_node + i]);
    }
}

TEST(Nodes, OfAllLatticesFollowEachOtherNoFartherApartThanAsked) {
    const Laid& laid = furnished_room();
    size_t next = 0;
    for (const SurfaceGrid& grid : laid.grids_of_patches) {
        EXPECT_EQ(grid.lattice.first_node, next);
        next += grid.lattice.columns * grid.lattice.rows;
        EXPECT_GT(std::min(grid.lattice.step.x, grid.lattice.step.y), 0);
        EXPECT_LE(std::max(grid.lattice.step.x, grid.lattice.step.y), 1.0001f * spacing);
        EXPECT_GE(std::min(grid.lattice.columns, grid.lattice.rows), 2u);
    }
    EXPECT_EQ(laid.nodes.size(), next);
}

TEST(Nodes, SpanTheirTrianglesFromRimToRim) {
    const Laid& laid = furnished_room();
    for (size_t side = 0; side < laid.patches.of_side.size(); ++side) {
        const SurfaceGrid& grid = laid.grids_of_patches[laid.patches.of_side[side]];
        const vec2 low = grid.lattice.low - 1e-4f,
                   high = grid.lattice.low + 1e-4f +
                          grid.lattice.step * vec2(float(grid.lattice.columns - 1), float(grid.lattice.rows - 1));
        for (int c = 0; c < 3; ++c) {
            const vec3 p = Laid::in_grid(grid, laid.scene.positions[laid.scene.triangles[side / 2][c]]);
            EXPECT_TRUE(p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y) << side;
        }
    }
}

TEST(Nodes, LieOnATriangleOfTheirPatchWhereTheySayTheyDo) {
    const Laid& laid = furnished_room();
    size_t over = 0, beside = 0;
    for_each_place(laid, [&](const SurfaceGrid& grid, size_t m, vec2 place, const NodePoint& node) {
        if (!node.exists()) return;
        EXPECT_TRUE(laid.patches.of_side[2 * node.triangle] == m || laid.patches.of_side[2 * node.triangle + 1] == m);
        const vec3 p = Laid::in_grid(grid, laid.position_of(node));
        const float drawn_in = 0.021f * length(grid.lattice.step);
        EXPECT_NEAR(p.z, node.height, drawn_in + 1e-4f);
        const float distance = length(vec2(p) - place);
        EXPECT_NEAR(distance, std::sqrt(node.distance2), drawn_in + 1e-4f);
        EXPECT_LE(distance, 1.04f * length(grid.lattice.step));
        ++(node.distance2 == 0 ? over : beside);
    });
    EXPECT_GT(over, 1000u);
    EXPECT_GT(beside, 100u);
}

TEST(Nodes, HaveTheNearestPointOfAllTrianglesOfTheirPatch) {
    const Laid& laid = furnished_room();
    std::vector<std::vector<uint>> sides(laid.grids_of_patches.size());
    for (uint side = 0; side < laid.patches.of_side.size(); ++side) sides[laid.patches.of_side[side]].push_back(side);
    size_t checked = 0, without = 0;
    for_each_place(laid, [&](const SurfaceGrid& grid, size_t m, vec2 place, const NodePoint& node) {
        if (checked++ % 7 != 0) return;
        const float diagonal = length(grid.lattice.step);
        float nearest = 1e30f, offered = 1e30f;  // of all; of those whose bounds are at most a step away
        for (uint side : sides[m]) {
            std::array<vec3, 3> p;
            for (int c = 0; c < 3; ++c) {
                p[size_t(c)] = Laid::in_grid(grid, laid.scene.positions[laid.scene.triangles[side / 2][c]]);
                p[size_t(c)].z = 0;  // in projection
            }
            const vec3 at(place, 0), low = min(p[0], min(p[1], p[2])), high = max(p[0], max(p[1], p[2]));
            const float distance = length(closest_point_on_triangle(at, p[0], p[1], p[2]) - at);
            nearest = std::min(nearest, distance);
            const vec2 beyond = max(vec2(low - at), vec2(at - high));
            if (beyond.x < 0.99f * grid.lattice.step.x && beyond.y < 0.99f * grid.lattice.step.y)
                offered = std::min(offered, distance);
        }
        if (node.exists()) {
            EXPECT_GE(std::sqrt(node.distance2), nearest - 1.1e-3f * diagonal);
            EXPECT_LE(std::sqrt(node.distance2), offered + 1.1e-3f * diagonal);
        } else {
            EXPECT_GT(offered, 0.99f * diagonal);
            ++without;
        }
    });
    EXPECT_GT(without, 0u);
}

TEST(Nodes, LieOnTheHighestWhereSheetsOverlap) {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 1), vec3(1, 0, 0), 0.5f);
    lab.add_rectangle("sheet", vec3(0, 0.002f, 0), vec3(0, 0, 1), vec3(1, 0, 0), 0.5f);
    Scene scene = lab.finish();
    std::fill(scene.triangle_objects.begin(), scene.triangle_objects.end(), 0u);
    const Laid laid(std::move(scene), 8, 0.1f);
    size_t seen = 0;
    for_each_place(laid, [&](const SurfaceGrid& grid, size_t, vec2, const NodePoint& node) {
        if (!node.exists()) return;
        EXPECT_NEAR(laid.position_of(node).y, grid.normal.y > 0 ? 0.002f : 0.0f, 1e-6f);
        ++seen;
    });
    EXPECT_GT(seen, 200u);
}

TEST(Nodes, MoreThan32BitsCountAreRefused) { EXPECT_THROW(Laid(make_room({10'000, 2}), 1.5f, 1e-4f), Error); }

}  // namespace
}  // namespace lw
