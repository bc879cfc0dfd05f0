// Which lamps the nodes of a lattice see, against rays by brute force.
#include "maps/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "maps/room_with_board.h"

namespace lw {
namespace {

using namespace test;

TEST(Visibility, NodesSeeALampWhereARayReachesIt) {
    const BakedLab& lab = room_with_board();
    const auto lamps = uint(lab.scene.lights.size());
    size_t lit = 0, dark = 0;
    for_each_node(lab, [&](const Node& node) {
        const SurfaceGrid& grid = lab.map.grids[node.map];
        const vec3 p = node.on_triangle, to_wall = min(abs(p), abs(vec3(6, 3, 4) - p));
        const int walls = int(to_wall.x < 1e-3f) + int(to_wall.y < 1e-3f) + int(to_wall.z < 1e-3f);
        if (walls > 1) return;  // at an edge of the room rounding decides which side of the other wall a ray leaves
        for (uint lamp = 0; lamp < lamps; ++lamp) {
            if (is_at_border(lab, p, grid, lab.scene.lights[lamp])) continue;
            const bool expected = is_lit(lab, p, grid.normal, lab.scene.lights[lamp]);
            EXPECT_EQ(bits_of(lab.map, lamps, node.index, lamp) >> own_shift, expected ? some_visible : some_hidden)
                << "lamp " << lamp << " at " << p.x << " " << p.y << " " << p.z;
            ++(expected ? lit : dark);
        }
    });
    EXPECT_GT(lit, 1000u);
    EXPECT_GT(dark, 300u);
}

TEST(Visibility, SurroundingsOfANodeAreTheNineNodesAroundIt) {
    const BakedLab& lab = room_with_board();
    const auto lamps = uint(lab.scene.lights.size());
    for (const SurfaceGrid& grid : lab.map.grids) {
        const int columns = int(grid.lattice.columns), rows = int(grid.lattice.rows);
        if (grid.columns == 0) continue;
        for (int i = 0; i < columns * rows; ++i)
            for (uint lamp = 0; lamp < lamps; ++lamp) {
                uint around = 0;
                for (int y = std::max(i / columns - 1, 0); y <= std::min(i / columns + 1, rows - 1); ++y)
                    for (int x = std::max(i % columns - 1, 0); x <= std::min(i % columns + 1, columns - 1); ++x)
                        around |=
                            bits_of(lab.map, lamps, grid.lattice.first_node + uint(y * columns + x), lamp) >> own_shift;
                ASSERT_EQ(bits_of(lab.map, lamps, grid.lattice.first_node + uint(i), lamp) & 3u, around) << i;
            }
    }
}

}  // namespace
}  // namespace lw
