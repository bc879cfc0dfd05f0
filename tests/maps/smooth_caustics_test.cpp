// Caustics that lattice nodes hold: wide and even ones, with the light they have; never sharp ones.
#include "maps/smooth_caustics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/photons_on_floor.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.4f, step = 0.2f;  // m; of the lattice at most
constexpr uint lamp = 1;

/// A floor with a lattice, and what its nodes keep of caustics whose photons lie in rows on a square in its middle.
struct CausticFloor {
    CausticFloor(float side, float apart, float lux, uint record = 0) {
        const auto below = [&](float x, float z) { return *photon_below(caster, vec3(x, 1, z), 0); };
        const std::vector<Photon> others{below(1, 5), below(5, 1)};
        lattice =
            lay_lattice(scene, caster, partition, sort_into_grids({scene, caster, partition, others}, {}).surfaces);
        std::vector<Photon> photons =
            photons_in_rows(caster, 3 - 0.5f * side, 3 + 0.5f * side, apart, lamp, path_caustic);
        for (Photon& p : photons) p.flux *= lux;
        const PhotonGrids caustics = sort_into_grids({scene, caster, partition, photons}, {.flux_scale = 16});
        NodeIrradiance before{std::vector<uint>(2 * lattice.nodes.size(), record), scale};
        kept = add_smooth_caustics(scene, lattice, caustics, std::move(before));
    }
    bool marked(size_t node) const { return (kept.marks[node / 32] >> (node % 32)) & 1u; }
    vec3 lux_of(uint of_lamp, size_t node) const {
        return unpack_rgb9e5(kept.irradiance.records[of_lamp * lattice.nodes.size() + node]) / scale;
    }
    /// Calls visit(place, node) for all nodes over the floor.
    template <class Visit>
    void for_each_node(const Visit& visit) const {
        for (const SurfaceGrid& grid : lattice.surfaces.grids)
            for (uint i = 0; i < grid.lattice.columns * grid.lattice.rows; ++i) {
                const vec2 cells(float(i % grid.lattice.columns), float(i / grid.lattice.columns));
                const size_t node = grid.lattice.first_node + i;
                if (lattice.nodes[node].exists() && lattice.nodes[node].distance2 == 0)
                    visit(position_of(grid, vec3(grid.lattice.low + cells * grid.lattice.step, 0)), node);
            }
    }

    static constexpr float scale = 8;
    Scene scene = floor_with_two_lamps();
    RayCaster caster{scene};
    Partition partition = partition_surfaces(scene, caster, {.radius = radius});
    Lattice lattice;
    SmoothCaustics kept;
};

float from_middle(vec3 p) { return std::max(std::abs(p.x - 3), std::abs(p.z - 3)); }

/// Photons this far apart have a kernel of so many metres.
float apart_for(float kernel) { return std::sqrt(lw_pi * kernel * kernel / caustic_neighbours); }

TEST(SmoothCaustics, AWideEvenOneIsHeldWithItsLight) {
    const CausticFloor floor(5, apart_for(1.8f * step), 20);
    size_t lit = 0;
    floor.for_each_node([&](vec3 p, size_t node) {
        EXPECT_EQ(floor.lux_of(0, node), vec3(0)) << "not the lamp of the caustic";
        if (from_middle(p) > 2.5f - radius) return;
        EXPECT_TRUE(floor.marked(node)) << p.x << " " << p.z;
        EXPECT_NEAR(floor.lux_of(lamp, node).y, 20, 0.6f) << p.x << " " << p.z;
        ++lit;
    });
    EXPECT_GT(lit, 300u);
}

TEST(SmoothCaustics, OneWithANarrowKernelIsLeftToPixels) {
    const CausticFloor floor(4, apart_for(1.2f * step), 20);
    size_t lit = 0;
    floor.for_each_node([&](vec3 p, size_t node) {
        if (from_middle(p) > 2 - radius) return;
        EXPECT_FALSE(floor.marked(node)) << p.x << " " << p.z;
        EXPECT_EQ(floor.lux_of(lamp, node), vec3(0));
        ++lit;
    });
    EXPECT_GT(lit, 200u);
}

TEST(SmoothCaustics, ASharpFocusIsLeftToPixelsAndTheDarkAroundItIsHeld) {
    const CausticFloor floor(0.3f, 0.005f, 1000);
    size_t bright = 0, dark = 0;
    floor.for_each_node([&](vec3 p, size_t node) {
        if (from_middle(p) < 0.15f) {
            EXPECT_FALSE(floor.marked(node)) << p.x << " " << p.z;
            ++bright;
        } else if (from_middle(p) > 0.15f + radius) {
            EXPECT_TRUE(floor.marked(node)) << p.x << " " << p.z;
            ++dark;
        }
        if (!floor.marked(node)) {
            EXPECT_EQ(floor.lux_of(lamp, node), vec3(0));
        }
    });
    EXPECT_GE(bright, 2u);
    EXPECT_GT(dark, 500u);
}

TEST(SmoothCaustics, AreAddedToTheLightThatIsThere) {
    const CausticFloor floor(5, apart_for(1.8f * step), 20, pack_rgb9e5(vec3(1, 2, 4) * CausticFloor::scale));
    size_t lit = 0;
    floor.for_each_node([&](vec3 p, size_t node) {
        EXPECT_EQ(floor.lux_of(0, node), vec3(1, 2, 4));
        if (from_middle(p) > 2.5f - radius) return;
        EXPECT_LT(length(floor.lux_of(lamp, node) - vec3(21, 22, 24)), 1.0f) << p.x << " " << p.z;
        ++lit;
    });
    EXPECT_GT(lit, 300u);
}

TEST(SmoothCaustics, OneTooBrightForARecordIsLeftToPixels) {
    for (const float lux : {0.9f * 32768 / CausticFloor::scale, 1.1f * 32768 / CausticFloor::scale}) {
        const CausticFloor floor(5, apart_for(1.8f * step), lux);
        floor.for_each_node([&](vec3 p, size_t node) {
            if (from_middle(p) > 2) return;
            EXPECT_EQ(floor.marked(node), lux < 32768 / CausticFloor::scale) << lux;
        });
    }
}

TEST(SmoothCaustics, WithoutPhotonsEveryNodeHoldsThem) {
    const CausticFloor floor(0, 1, 0);
    floor.for_each_node([&](vec3 p, size_t node) { EXPECT_TRUE(floor.marked(node)) << p.x << " " << p.z; });
}

TEST(SmoothCaustics, NodesWithoutAPointAreNotMarked) {
    const CausticFloor floor(5, apart_for(1.8f * step), 20);
    size_t without = 0;
    for (size_t node = 0; node < floor.lattice.nodes.size(); ++node)
        if (!floor.lattice.nodes[node].exists()) {
            EXPECT_FALSE(floor.marked(node));
            ++without;
        }
    EXPECT_GT(without, 0u);
}

}  // namespace
}  // namespace lw
