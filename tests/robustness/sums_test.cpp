// Sums over millions of photons do not drift: the estimate over 64 million equal photons is their flux over their area,
// the balance of a lamp is what it sends out.
#include <gtest/gtest.h>

#include <cmath>

#include "maps/estimate.h"
#include "maps/packing.h"
#include "maps/photon_sums.h"
#include "photons/shoot.h"
#include "robustness/room.h"

namespace lw::test {
namespace {

/// side x side photons of flux 1 lm, evenly over the floor of 4 x 4 m of a scene of two triangles, as a map would hold
/// them.
struct EvenPhotons {
    explicit EvenPhotons(uint side) : scene(load(floor_room())) {
        SurfaceGrid grid{};
        grid.u_axis = {1, 0, 0}, grid.v_axis = {0, 0, 1}, grid.normal = {0, 1, 0};
        grid.origin = vec3(-2, scene.positions[0].y, -2);
        grid.columns = grid.rows = side / 2;
        grid.cell_size = 4.0f / float(grid.columns);
        grid.quantum = vec3(4.0f / 65536, 4.0f / 65536, 1e-6f);
        grid.radius = 1.9f;
        map.settings.radius = grid.radius;
        map.flux_scale = 1;
        map.grids = {grid};
        map.grid_of_side.assign(2 * scene.triangles.size(), 0);
        const uint step = 65536 / side;
        for (uint row = 0; row < grid.rows; ++row)
            for (uint column = 0; column < grid.columns; ++column) {
                map.cell_starts.push_back(uint(map.places.size()));
                for (uint i = 0; i < 4; ++i) {
                    const uint u = (2 * column + i % 2) * step + step / 2, v = (2 * row + i / 2) * step + step / 2;
                    map.places.push_back({u | v << 16, 0});
                }
            }
        map.cell_starts.push_back(uint(map.places.size()));
        map.fluxes.assign(map.places.size(), pack_rgb9e5(vec3(1)));
    }
    static Room floor_room() {
        Room room = plain_room();
        room.walls = quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
        room.block.clear(), room.panel.clear();
        room.lamp = {0, 1, 0}, room.eye = {0, 1, 0};
        return room;
    }
    Scene scene;
    PhotonMap map;
};

TEST(Sums, OfSixtyFourMillionEqualPhotonsAreTheirFluxOverTheirArea) {
    const EvenPhotons even(8192);
    ASSERT_EQ(even.map.places.size(), size_t(1) << 26);
    const std::vector<vec3> weights{vec3(1)};
    const PhotonEstimator estimator(even.scene, even.map, weights, {gather_mode_smooth, 1u << 30, 0});
    const Surface s = estimator.surface_at(0, vec2(0, 0.5f));
    const Gathered light = estimator.estimate(0, vec2(0, 0.5f), vec3(0, 1, 0));
    const double expected = double(even.map.places.size()) / 16;  // lm/m2
    tell_case("sum of 67 million equal photons", "N flux / A, +-0.05 %", "%+.4f %%, %.3g photons under the kernel",
              100 * (double(light.irradiance.y) / expected - 1), double(light.photons));
    EXPECT_GT(light.photons, 4e7f) << s.position.x << " " << s.position.z;
    EXPECT_NEAR(double(light.irradiance.y) / expected, 1, 5e-4);
}

/// The same at a node of a lattice, as a bake sums it: to what 16-bit places and floats of single photons allow.
TEST(Sums, OfSixteenMillionEqualPhotonsAtALatticeNodeDoNotDrift) {
    const EvenPhotons even(4096);
    const SurfaceGrid& grid = even.map.grids[0];
    const PhotonSums photons(even.map, grid);
    std::vector<vec4> parts(PhotonSums::sums_per_lamp, vec4(0));
    photons.add(vec3(2, 2, 0), grid.radius, parts);
    double sum = 0;
    for (const vec4& part : parts) sum += double(part.y);
    const double expected = double(even.map.places.size()) / 16 * M_PI * double(grid.radius) * double(grid.radius) / 2;
    tell_case("sum of 17 million equal photons at a node of a lattice", "N flux under the kernel, +-0.001 %",
              "%+.5f %%", 100 * (sum / expected - 1));
    EXPECT_NEAR(sum / expected, 1, 1e-5);
}

TEST(Sums, OfALampsPathsAreWhatItSendsOut) {
    const Baked baked(plain_room(), 2'000'000, 1, true);
    const LightBalance& lamp = baked.photons.lights[0];
    tell_case("flux of the paths of a lamp", "4 pi lm, +-1e-6", "%+.1e, %.3g paths", lamp.flux_out / (4 * M_PI) - 1,
              double(lamp.emitted));
    EXPECT_GT(lamp.emitted, 200'000u);
    EXPECT_NEAR(lamp.flux_out / (4 * M_PI), 1, 1e-6);
    EXPECT_NEAR((lamp.absorbed + lamp.escaped) / lamp.flux_out, 1, 1e-6);
}

}  // namespace
}  // namespace lw::test
