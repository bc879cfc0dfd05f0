// The shadows of small lamps in the cells of lattices, against rays by brute force.
#include "maps/shadow_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "maps/room_with_board.h"

namespace lw {
namespace {

using namespace test;

const SurfaceGrid& grid_of_cell(const PhotonMap& map, uint cell) {
    const auto holds = [&](const SurfaceGrid& grid) {
        return grid.columns > 0 && cell - grid.lattice.first_node < grid.lattice.columns * grid.lattice.rows;
    };
    return *std::find_if(map.grids.begin(), map.grids.end(), holds);
}

TEST(ShadowMasks, SayWhichOf64PlacesInACellALampLights) {
    const BakedLab& lab = room_with_board();
    size_t lit = 0, dark = 0, wrong = 0;
    for (const ShadowMask& mask : lab.map.shadow_masks) {
        const SurfaceGrid& grid = grid_of_cell(lab.map, mask.cell);
        const uint i = mask.cell - grid.lattice.first_node;
        const vec2 corner{float(i % grid.lattice.columns), float(i / grid.lattice.columns)};
        const Light& lamp = lab.scene.lights[mask.lamp];
        for (uint bit = 0; bit < 64; ++bit) {
            const vec2 texel = (vec2(float(bit % 8), float(bit / 8)) + 0.5f) / 8.0f;
            const vec3 p = point_on_lattice(grid, corner + texel, 0);
            const bool inside = std::min({p.x, p.y + 0.1f, p.z, 6 - p.x, 3.1f - p.y, 4 - p.z}) > 0.01f;
            if (!inside || is_at_border(lab, p, grid, lamp)) continue;
            const bool expected = is_lit(lab, p, grid.normal, lamp);
            const bool got = ((bit < 32 ? mask.lit_low : mask.lit_high) >> (bit % 32)) & 1u;
            wrong += got != expected;
            ++(expected ? lit : dark);
        }
        EXPECT_LT(length(unpack_rgb9e5(mask.tint) - vec3(1)), 1e-6);
    }
    EXPECT_GT(lit, 1000u);
    EXPECT_GT(dark, 1000u);
    EXPECT_LT(double(wrong), 0.002 * double(lit + dark));
}

TEST(ShadowMasks, AreThereForEveryLampThatTheNodesAroundACellDisagreeAbout) {
    const BakedLab& lab = room_with_board();
    const auto lamps = uint(lab.scene.lights.size());
    std::map<std::pair<uint, uint>, int> masks;
    for (const ShadowMask& mask : lab.map.shadow_masks) ++masks[{mask.cell, mask.lamp}];
    size_t expected = 0;
    for (const SurfaceGrid& grid : lab.map.grids)
        for (uint y = 0; grid.columns > 0 && y + 1 < grid.lattice.rows; ++y)
            for (uint x = 0; x + 1 < grid.lattice.columns; ++x)
                for (uint lamp = 0; lamp < lamps; ++lamp) {
                    const uint cell = grid.lattice.first_node + y * grid.lattice.columns + x;
                    uint around = 0;
                    for (uint node : {cell, cell + 1, cell + grid.lattice.columns, cell + grid.lattice.columns + 1})
                        around |= bits_of(lab.map, lamps, node, lamp) & 3u;
                    const bool differ = around == (some_visible | some_hidden);
                    EXPECT_EQ(masks.count({cell, lamp}), differ ? 1u : 0u) << cell << " " << lamp;
                    expected += differ;
                }
    EXPECT_EQ(lab.map.shadow_masks.size(), expected);
    EXPECT_GT(expected, 50u);
}

}  // namespace
}  // namespace lw
