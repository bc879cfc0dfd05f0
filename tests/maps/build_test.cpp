// The stations of a bake put together: what follows from the photons and the settings, and what goes where.
#include "maps/build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/photons_on_floor.h"

namespace lw {
namespace {

using namespace test;

struct BuiltFloor {
    /// The map of photons of lamp 0 that are reflected, and of lamp 1 that are caustic.
    BuiltFloor(float flux, bool with_caustics, BakeSettings settings = {.radius = 0.4f}) {
        for (const Photon& p : photons_in_rows(caster, 0, 6, 0.1f, 0, path_indirect)) photons.records.push_back(p);
        if (with_caustics)
            for (const Photon& p : photons_in_rows(caster, 2, 3, 0.02f, 1, path_caustic)) photons.records.push_back(p);
        photons.records.back().flux = vec3(0.1f * flux, flux, 0.3f * flux);
        photons.lights.resize(scene.lights.size());
        photons.lights[0].emitted = 5000, photons.lights[1].emitted = 7000;
        map = build_photon_map(scene, caster, photons, settings);
    }
    Scene scene = floor_with_two_lamps();
    RayCaster caster{scene};
    Photons photons;
    PhotonMap map;
};

TEST(Build, AreaIsThatOfAllTriangles) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(2, 3, 5), 0.5f);
    EXPECT_NEAR(area_of(lab.finish()), 2 * (2 * 3 + 3 * 5 + 5 * 2), 1e-4);
    EXPECT_EQ(area_of(Scene{}), 0);
}

TEST(Build, TheRadiusIsKeptIfGiven) {
    const BuiltFloor found(0.01f, false, {}), given(0.01f, false);
    EXPECT_EQ(found.map.settings.radius, 0);
    EXPECT_EQ(given.map.settings.radius, 0.4f);
}

TEST(Build, DirectionsAreNeededWhereASurfaceShinesOrIsBumpy) {
    const auto needs = [](const auto& change) {
        Scene scene = floor_with_two_lamps();
        change(scene.materials[0]);
        return needs_directions(scene);
    };
    EXPECT_FALSE(needs([](Material&) {}));
    EXPECT_TRUE(needs([](Material& m) { m.metallic = 0.1f; }));
    EXPECT_TRUE(needs([](Material& m) { m.specular = 0.1f; }));
    EXPECT_TRUE(needs([](Material& m) { m.normal_texture.texture = 0; }));
}

TEST(Build, KeepsWhatIsKnownOfThePhotons) {
    const BuiltFloor floor(0.01f, true);
    EXPECT_EQ(floor.map.stored_photons, 3600u + 2500u);
    EXPECT_EQ(floor.map.emitted, (std::vector<uint64_t>{5000, 7000}));
    EXPECT_EQ(floor.map.scene_hash, floor.scene.content_hash);
    EXPECT_FALSE(floor.map.has_directions());
}

TEST(Build, TheBrightestFluxComesBelowTwoToTheTwelfth) {
    for (const float flux : {0.5f, 1.0f, 3.0f, 700.0f}) {
        const BuiltFloor floor(flux, false);
        float top = 0;
        for (uint record : floor.map.fluxes) top = std::max(top, unpack_rgb9e5(record).y);
        EXPECT_NEAR(top, flux * floor.map.flux_scale, 0.005f * top);
        EXPECT_TRUE(top > 2048 && top <= 4096) << top;
        int exponent;
        EXPECT_EQ(std::frexp(floor.map.flux_scale, &exponent), 0.5f) << "a power of two";
    }
}

TEST(Build, CausticsHaveGridsBehindTheOthersAndTheirLampNoOther) {
    const BuiltFloor floor(0.01f, true);
    ASSERT_GT(floor.map.caustic_grids, 0u);
    const size_t others = floor.map.grids.size() - floor.map.caustic_grids;
    for (size_t m = 0; m < floor.map.grids.size(); ++m) {
        const SurfaceGrid& grid = floor.map.grids[m];
        EXPECT_EQ(grid.lattice.columns == 0, m >= others) << m;
        for (uint i = floor.map.cell_starts[grid.first_cell];
             i < floor.map.cell_starts[grid.first_cell + grid.columns * grid.rows]; ++i)
            EXPECT_EQ(light_of(floor.map.places[i]), m >= others ? 1u : 0u);
    }
    for (const Photon& p : floor.photons.records) {
        const uint grid = floor.map.behind_cuts(
            p.light() == 1 ? floor.map.caustic_grid_of(2 * p.triangle) : floor.map.grid_of_side[2 * p.triangle],
            p.position);
        EXPECT_TRUE(grid != no_grid && (grid >= others) == (p.light() == 1));
    }
    EXPECT_EQ(floor.map.caustic_grid_of(1), no_grid);  // the lower side
    EXPECT_EQ(floor.map.smooth_caustics.size(), (floor.map.coverage.size() + 31) / 32);
}

TEST(Build, WithoutCausticsThereIsNothingOfThem) {
    const BuiltFloor floor(0.01f, false);
    EXPECT_EQ(floor.map.caustic_grids, 0u);
    EXPECT_TRUE(floor.map.caustic_sides.empty());
    EXPECT_TRUE(floor.map.smooth_caustics.empty());
}

TEST(Build, LampsAreLookedAtUnlessPhotonsHoldAllLight) {
    const BuiltFloor by_rays(0.01f, true), by_photons(0.01f, true, {.radius = 0.4f, .direct_in_photons = true});
    EXPECT_EQ(by_rays.map.visible_lamps.size(), by_rays.map.coverage.size());
    EXPECT_TRUE(by_photons.map.visible_lamps.empty());
    EXPECT_TRUE(by_photons.map.shadow_masks.empty());
    EXPECT_TRUE(by_photons.map.smooth_caustics.empty());
    EXPECT_EQ(by_photons.map.caustic_grids, by_rays.map.caustic_grids);
}

}  // namespace
}  // namespace lw
