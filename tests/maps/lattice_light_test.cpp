// What pixels read of the cells of lattices: the light at their corners, and what is known of each lamp.
#include "maps/lattice_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/room_with_board.h"

namespace lw {
namespace {

using namespace test;

/// The cells of the room with a board: two points and a spot.
struct BoardCells {
    const BakedLab& lab = room_with_board();
    const PhotonMap& map = lab.map;
    uint lamps = uint(lab.scene.lights.size()), nodes = uint(map.coverage.size());
    uint row_length = lattice_row_length(lamps, map.has_marks());
    LatticeLight cells{lab.scene, map};

    uint bits_at(uint cell, uint lamp) const {
        const uint bits = cells.rows()[cell * row_length + (map.has_marks() ? 1 : 0) + lattice_lamp_column(lamp)];
        return lattice_lamp_bits(bits, lattice_lamp_shift(lamp));
    }
    /// Calls visit(grid, cell, its corners).
    template <class Visit>
    void for_each_cell(const Visit& visit) const {
        for (const SurfaceGrid& grid : map.grids)
            for (uint y = 0; y + 1 < grid.lattice.rows; ++y)
                for (uint x = 0; x + 1 < grid.lattice.columns; ++x) {
                    const uint cell = grid.lattice.first_node + y * grid.lattice.columns + x;
                    visit(grid, cell,
                          std::array<uint, 4>{cell, cell + 1, cell + grid.lattice.columns,
                                              cell + grid.lattice.columns + 1});
                }
    }
    vec3 corner_of(const SurfaceGrid& grid, uint node) const {
        const uint i = node - grid.lattice.first_node;
        return point_on_lattice(grid, vec2(float(i % grid.lattice.columns), float(i / grid.lattice.columns)),
                                PlaneGrids(lab.scene, map).height(size_t(&grid - map.grids.data())));
    }
    const ShadowMask* mask_of(uint cell, uint lamp) const {
        const auto found = std::find_if(map.shadow_masks.begin(), map.shadow_masks.end(),
                                        [&](const ShadowMask& m) { return m.cell == cell && m.lamp == lamp; });
        return found == map.shadow_masks.end() ? nullptr : &*found;
    }
};

const BoardCells& board_cells() {
    static const BoardCells cells;
    return cells;
}

bool is_all_lit(const ShadowMask& mask) { return (mask.lit_low & mask.lit_high) == ~0u; }
bool is_all_dark(const ShadowMask& mask) { return (mask.lit_low | mask.lit_high) == 0; }

/// Lux from a point or spot lamp of one candela, inside the spot's beam.
double lux_at(const Light& lamp, vec3 position, vec3 normal) {
    const glm::dvec3 path = glm::dvec3(lamp.position) - glm::dvec3(position);
    return glm::dot(path, glm::dvec3(normal)) / std::pow(glm::length(path), 3);
}

TEST(LatticeLight, CornersHaveTheirNodesIrradianceTimesPowersAndTheHeldLamps) {
    const BoardCells& board = board_cells();
    const std::vector<vec3> powers{vec3(100, 50, 20), vec3(3, 70, 9), vec3(40)};
    std::vector<uvec4> light;
    const double scale = double(board.cells.sum(powers, light));
    EXPECT_NEAR(scale, double(board.cells.scale_of(powers) * board.map.irradiance_scale), 1e-6 * scale);
    const PlaneGrids planes(board.lab.scene, board.map);
    size_t lit = 0, held = 0;
    board.for_each_cell([&](const SurfaceGrid& grid, uint cell, const std::array<uint, 4>& corners) {
        for (int c = 0; c < 4; ++c) {
            const uint node = corners[size_t(c)], i = node - grid.lattice.first_node;
            glm::dvec3 expected(0);
            for (uint lamp = 0; lamp < board.lamps; ++lamp) {
                expected += glm::dvec3(unpack_rgb9e5(board.map.irradiance[lamp * board.nodes + node])) /
                            double(board.map.irradiance_scale) * glm::dvec3(powers[lamp]);
                if (!(board.bits_at(cell, lamp) & in_lattice_light)) continue;
                const vec2 steps(float(i % grid.lattice.columns), float(i / grid.lattice.columns));
                const vec3 at = point_on_lattice(grid, steps, planes.height(size_t(&grid - board.map.grids.data())));
                expected += lux_at(board.lab.scene.lights[lamp], at, grid.normal) * glm::dvec3(powers[lamp]);
                ++held;
            }
            const glm::dvec3 got = glm::dvec3(unpack_rgb9e5(light[cell][c])) / scale;
            EXPECT_LE(glm::length(got - expected), 0.004 * glm::length(expected)) << cell;
            lit += glm::length(expected) > 0;
        }
    });
    EXPECT_GT(lit, 1000u);
    EXPECT_GT(held, 1000u);
}

TEST(LatticeLight, HoldALampWhereAllCornersSeeItFromTwelveSteps) {
    const BoardCells& board = board_cells();
    size_t held = 0, left = 0;
    board.for_each_cell([&](const SurfaceGrid& grid, uint cell, const std::array<uint, 4>& corners) {
        const float step = std::max(grid.lattice.step.x, grid.lattice.step.y);
        for (uint lamp = 0; lamp < board.lamps; ++lamp) {
            const Light& light = board.lab.scene.lights[lamp];
            bool expected = (board.bits_at(cell, lamp) & (some_visible | some_hidden)) == some_visible;
            bool is_close = false;  // rounding decides
            for (uint node : corners) {
                const vec3 path = board.corner_of(grid, node) - light.position;
                const float cosine = dot(normalize(path), light.direction);
                is_close |= std::abs(length(path) - 12 * step) < 1e-4f;
                expected &= length(path) >= 12 * step;
                if (light.type != light_spot) continue;
                is_close |= std::abs(cosine - light.cos_inner) < 1e-5f;
                expected &= cosine >= light.cos_inner;
            }
            if (is_close) continue;
            EXPECT_EQ((board.bits_at(cell, lamp) & in_lattice_light) != 0, expected) << cell << " " << lamp;
            ++(expected ? held : left);
        }
    });
    EXPECT_GT(held, 200u);
    EXPECT_GT(left, 200u);
}

TEST(LatticeLight, KnowWhichLampsTheirCornersSee) {
    const BoardCells& board = board_cells();
    size_t seen = 0, hidden = 0, mixed = 0;
    board.for_each_cell([&](const SurfaceGrid&, uint cell, const std::array<uint, 4>& corners) {
        for (uint lamp = 0; lamp < board.lamps; ++lamp) {
            uint around = 0, sees = 0;
            for (uint c = 0; c < 4; ++c) {
                const uint bits = bits_of(board.map, board.lamps, corners[c], lamp);
                around |= bits & (some_visible | some_hidden);
                if ((bits >> own_shift) & some_visible) sees |= 1u << c;
            }
            if (const ShadowMask* mask = board.mask_of(cell, lamp)) {
                if (is_all_lit(*mask)) around = some_visible;
                if (is_all_dark(*mask)) around = some_hidden;
            }
            EXPECT_EQ(board.bits_at(cell, lamp) & (some_visible | some_hidden), around) << cell << " " << lamp;
            EXPECT_EQ(seeing_corners(board.bits_at(cell, lamp)), sees) << cell << " " << lamp;
            ++(around == some_visible ? seen : around == some_hidden ? hidden : mixed);
        }
    });
    EXPECT_GT(std::min({seen, hidden, mixed}), 50u);
}

TEST(LatticeLight, LeaveLampsToRaysWhereMasksAreNeitherLitNorDark) {
    const BoardCells& board = board_cells();
    size_t masked = 0, settled = 0;
    for (uint cell = 0; cell < board.nodes; ++cell) {
        uint next = board.cells.rows()[cell * board.row_length] >> first_mask_shift;
        for (uint lamp = 0; lamp < board.lamps; ++lamp) {
            const ShadowMask* mask = board.mask_of(cell, lamp);
            const bool keeps = mask && !is_all_lit(*mask) && !is_all_dark(*mask);
            ASSERT_EQ((board.bits_at(cell, lamp) & has_shadow_mask) != 0, keeps) << cell << " " << lamp;
            settled += mask && !keeps;
            if (!keeps) continue;
            const uvec4 expected(mask->lit_low, mask->lit_high, mask->tint, 0);
            EXPECT_TRUE(board.cells.masks().at(next) == expected) << cell << " " << lamp;
            EXPECT_FALSE(board.bits_at(cell, lamp) & in_lattice_light);
            ++next, ++masked;
        }
    }
    EXPECT_EQ(masked, board.cells.masks().size());
    EXPECT_GT(masked, 100u);
    EXPECT_GT(settled, 10u);
}

TEST(LatticeLight, MarkCornersThatHoldCaustics) {
    const BoardCells& board = board_cells();
    PhotonMap map = board.map;
    map.smooth_caustics.assign((board.nodes + 31) / 32, 0);
    const uint node = map.grids[0].lattice.first_node + map.grids[0].lattice.columns + 1;
    map.smooth_caustics[node / 32] |= 1u << (node % 32);
    const LatticeLight cells(board.lab.scene, map);
    size_t marked = 0;
    board.for_each_cell([&](const SurfaceGrid&, uint cell, const std::array<uint, 4>& corners) {
        uint expected = 0;
        for (uint c = 0; c < 4; ++c) expected |= corners[c] == node ? 1u << c : 0;
        EXPECT_EQ(cells.rows()[cell * board.row_length] & 15u, expected) << cell;
        marked += expected != 0;
    });
    EXPECT_EQ(marked, 4u);
}

TEST(LatticeLight, TheScaleBringsThePowersToOneAndTheDirectLightIntoRecords) {
    const BoardCells& board = board_cells();
    float brightest = 0;
    for (uint bits : board.cells.direct().values) brightest = std::max(brightest, uintBitsToFloat(bits));
    const float room = std::min(1.0f, 4096 / (brightest * board.map.irradiance_scale));
    EXPECT_NEAR(board.cells.scale_of(std::vector<vec3>{vec3(1, 3, 2), vec3(4, 0, 0), vec3(0)}), room / 7, 1e-6f * room);
    EXPECT_EQ(board.cells.scale_of(std::vector<vec3>(3, vec3(0))), room);
}

TEST(LatticeLight, KnowNothingWherePhotonsHoldAllLight) {
    const BoardCells& board = board_cells();
    PhotonMap map = board.map;
    map.visible_lamps.clear();
    const LatticeLight cells(board.lab.scene, map);
    EXPECT_TRUE(cells.rows().empty());
    EXPECT_TRUE(cells.punctual().empty());
    std::vector<uvec4> light;
    const std::vector<vec3> powers(board.lamps, vec3(1));
    EXPECT_GT(cells.sum(powers, light), 0);
    EXPECT_EQ(light.size(), board.nodes);
}

}  // namespace
}  // namespace lw
