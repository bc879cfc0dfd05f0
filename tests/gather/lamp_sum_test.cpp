#include "gather/lamp_sum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gpu/commands.h"
#include "maps/bake.h"
#include "rooms.h"

namespace lw {
namespace {

/// A room with eight lamps, panels and points by turns, and the sums of its lamps on lavapipe.
struct Summed {
    Summed()
        : scene(make_room({2000, 8})),
          caster(scene),
          map(bake(scene, caster, {.photons = 40'000})),
          cells(scene, map),
          device({"llvmpipe", true, {}}),
          sum(device, scene, map, cells),
          setting(sum.make_setting()) {
        for (const Light& light : scene.lights) powers.push_back(light.intensity);
    }
    void record(bool whole) {
        submit_and_wait(device, [&](vk::CommandBuffer commands) { sum.record(commands, setting, powers, whole); });
    }
    std::vector<uvec4> on_device() const {
        return read_back<uvec4>(device, setting.cells, setting.cells.size() / sizeof(uvec4));
    }
    std::vector<uvec4> on_processor() const {
        std::vector<uvec4> light;
        cells.sum(powers, light);
        return light;
    }
    /// Calls visit(cell) for every cell of the lattices.
    template <class Visit>
    void for_each_cell(const Visit& visit) const {
        for (const SurfaceGrid& grid : map.grids)
            for (uint y = 0; y + 1 < grid.lattice.rows; ++y)
                for (uint x = 0; x + 1 < grid.lattice.columns; ++x)
                    visit(grid.lattice.first_node + y * grid.lattice.columns + x);
    }

    Scene scene;
    RayCaster caster;
    PhotonMap map;
    LatticeLight cells;
    Device device;
    LampSum sum;
    LampSumSetting setting;
    std::vector<vec3> powers;
};

void expect_the_same_cells(const Summed& s) {
    const std::vector<uvec4> device = s.on_device(), processor = s.on_processor();
    size_t lit = 0, others = 0;
    s.for_each_cell([&](uint cell) {
        lit += processor[cell] != uvec4(0);
        others += device[cell] != processor[cell];
    });
    EXPECT_GT(lit, 100u);
    EXPECT_EQ(others, 0u);
}

/// Largest difference of a channel at the corners of all cells, in parts of the corner's brightest one.
double largest_difference(const Summed& s, const std::vector<uvec4>& a, float scale_a, const std::vector<uvec4>& b,
                          float scale_b) {
    double largest = 0;
    s.for_each_cell([&](uint cell) {
        for (int c = 0; c < 4; ++c) {
            const vec3 x = unpack_rgb9e5(a[cell][c]) / scale_a, y = unpack_rgb9e5(b[cell][c]) / scale_b;
            const float top = std::max({x.x, x.y, x.z, y.x, y.y, y.z, 1e-20f});
            for (int i = 0; i < 3; ++i) largest = std::max(largest, double(abs(x[i] - y[i]) / top));
        }
    });
    return largest;
}

TEST(LampSum, OfAllLampsIsThatOfTheProcessorToTheBit) {
    Summed s;
    s.record(true);
    expect_the_same_cells(s);
    for (size_t lamp = 0; lamp < s.powers.size(); ++lamp) s.powers[lamp] *= vec3(0.1f * float(lamp), 1, 0.7f);
    s.record(true);
    expect_the_same_cells(s);
}

TEST(LampSum, OfLampsThatChangedOneByOneIsTheWholeSum) {
    Summed s;
    s.record(true);
    for (size_t round = 0; round < 24; ++round) {
        s.powers[round % s.powers.size()] *= round % 3 == 0 ? 0.25f : 1.5f;
        s.record(false);
    }
    EXPECT_FALSE(s.setting.is_whole) << "else nothing was added";
    const float scale = s.sum.record_scale(s.setting);
    const auto added = read_back<vec4>(s.device, s.setting.node_sums, s.map.coverage.size());
    const std::vector<uvec4> added_cells = s.on_device();
    s.record(true);
    EXPECT_TRUE(s.setting.is_whole);
    const auto whole = read_back<vec4>(s.device, s.setting.node_sums, s.map.coverage.size());
    const float whole_scale = s.sum.record_scale(s.setting);
    float top = 0;
    for (const vec4& v : whole) top = std::max({top, v.x, v.y, v.z});
    double largest = 0;
    for (size_t n = 0; n < whole.size(); ++n)
        largest = std::max(largest, double(length(added[n] * (whole_scale / scale) - whole[n]) / top));
    EXPECT_LT(largest, 1e-6);
    // Packed at another scale, each is rounded by up to half a step of nine bits.
    EXPECT_LT(largest_difference(s, added_cells, scale, s.on_device(), whole_scale), 1.01 / 256);
    expect_the_same_cells(s);
}

TEST(LampSum, IsMadeAnewWhenLampsBecomeMuchBrighter) {
    Summed s;
    for (vec3& power : s.powers) power *= 1e-3f;
    s.record(false);
    s.powers[1] *= 1e4f;
    s.record(false);
    EXPECT_TRUE(s.setting.is_whole);
    expect_the_same_cells(s);
}

TEST(LampSum, OfNoLampIsDarkAndComesBack) {
    Summed s;
    s.record(true);
    const std::vector<vec3> lit = s.powers;
    for (vec3& power : s.powers) power = vec3(0);
    s.record(false);
    const std::vector<uvec4> dark = s.on_device();
    s.for_each_cell([&](uint cell) { ASSERT_EQ(dark[cell], uvec4(0)) << cell; });
    s.powers = lit;
    s.record(false);
    expect_the_same_cells(s);
}

}  // namespace
}  // namespace lw
