// Which lamps the nodes of a lattice see, against rays by brute force.
#include "maps/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "maps/room_with_board.h"

namespace lw {
namespace {

using namespace test;

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
