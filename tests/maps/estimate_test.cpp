// The maps and the density estimate against closed forms and brute force.
#include "maps/estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/parallel.h"
#include "benchmark/rooms.h"
#include "maps/bake.h"
#include "maps/build.h"
#include "photons/shoot.h"
#include "scene/gltf.h"
#include "scene/triangle.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

struct Baked {
    explicit Baked(const std::string& name, uint64_t count = 200000)
        : scene(load_gltf(file_in_data(name))),
          caster(scene),
          photons(shoot_photons(scene, caster, {.photons = count, .direct_in_photons = true})),
          map(build_photon_map(scene, caster, photons, {.photons = count, .direct_in_photons = true})),
          weights(lamp_powers(scene, {})) {}
    Scene scene;
    RayCaster caster;
    Photons photons;
    PhotonMap map;
    std::vector<vec3> weights;
};

bool same_bytes(const PhotonMap& a, const PhotonMap& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return same(a.places, b.places) && same(a.fluxes, b.fluxes) && same(a.directions, b.directions) &&
           same(a.grids, b.grids) && same(a.cell_starts, b.cell_starts) && same(a.grid_of_side, b.grid_of_side);
}

TEST(Bake, GivesTheSameBytesAtOneAndTwoThreads) {
    const auto map_of = [](unsigned threads) {
        const ThreadLimit limit(threads);  // one at a time: of several the smallest holds
        return Baked("cornell.gltf", 50000).map;
    };
    EXPECT_TRUE(same_bytes(map_of(1), map_of(2)));
}

TEST(Bake, AnotherSeedGivesOtherPhotons) {
    const Scene scene = load_gltf(file_in_data("cube.gltf"));
    const RayCaster caster(scene);
    const Photons a = shoot_photons(scene, caster, {.photons = 1000}),
                  b = shoot_photons(scene, caster, {.photons = 1000, .seed = 2});
    ASSERT_FALSE(a.records.empty());
    EXPECT_NE(a.records[0].position, b.records[0].position);
}

TEST(Bake, ARadiusTooSmallForTheSceneIsRefused) {
    const Scene scene = load_gltf(file_in_data("cube.gltf"));
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000});
    EXPECT_THROW(build_photon_map(scene, caster, photons, {.photons = 1000, .radius = 1e-6f}), Error);
}

TEST(Bake, ARadiusLargerThanTheSceneIsItsSize) {
    const Scene scene = load_gltf(file_in_data("cube.gltf"));
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000});
    EXPECT_EQ(build_photon_map(scene, caster, photons, {.photons = 1000, .radius = 1e9f}).settings.radius,
              scene.size());
}

TEST(Photons, AWhiteFloorUnderTheSkyIsLitAlthoughItAbsorbsNothing) {
    Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/cube.gltf");
    scene.triangles.resize(2);
    scene.triangle_objects.resize(2);
    for (Material& m : scene.materials) {
        m.base_color = vec4(1);
        m.metallic = 0;
        m.specular = 0;
    }
    const RayCaster caster(scene);
    const Photons photons = shoot_photons(scene, caster, {.photons = 1000});
    EXPECT_LT(photons.lights[0].absorbed, 1e-6 * photons.lights[0].flux_out);
    EXPECT_NO_THROW(build_photon_map(scene, caster, photons, {.photons = 1000}));
}

TEST(Photons, StoredFluxOfAClosedBoxIsEmittedOverOneMinusAlbedo) {
    const Baked cube("cube.gltf");
    double landed = 0;
    for (const Photon& p : cube.photons.records) landed += double(p.flux.y);
    EXPECT_NEAR(landed / (4 * M_PI), 1 / (1 - 0.5), 0.02);
    EXPECT_NEAR(cube.photons.lights[0].flux_out, 4 * M_PI, 1e-3);
    EXPECT_NEAR(cube.photons.lights[0].absorbed + cube.photons.lights[0].escaped, cube.photons.lights[0].flux_out,
                1e-6);
    EXPECT_NEAR(double(cube.photons.records.size()), 200000, 4000);
}

/// k nearest photons of the map over all its records, without the grid.
Gathered brute_force(const Baked& baked, uint map, vec3 position, uint k) {
    const SurfaceGrid& grid = baked.map.grids[map];
    const vec3 local = position_in_grid(grid, position);
    std::vector<std::pair<float, uint>> near;
    const uint begin = baked.map.cell_starts[grid.first_cell],
               end = baked.map.cell_starts[grid.first_cell + grid.columns * grid.rows];
    for (uint i = begin; i < end; ++i) {
        const vec3 d = place_in_grid(baked.map.places[i], grid) - local;
        const float excess = std::max(std::abs(d.z) - 0.01f * grid.radius, 0.0f);
        if (dot(d, d) < grid.radius * grid.radius && excess * excess <= 0.75f * dot(d, d))
            near.emplace_back(dot(d, d), i);
    }
    std::sort(near.begin(), near.end());
    const bool full = near.size() >= k;
    const size_t used = full ? k - 1 : near.size();
    const float r2 = full ? near[k - 1].first : grid.radius * grid.radius;
    Gathered sum{};
    for (size_t i = 0; i < used; ++i)
        sum.irradiance += unpack_rgb9e5(baked.map.fluxes[near[i].second]) *
                          baked.weights[light_of(baked.map.places[near[i].second])] /
                          (baked.map.flux_scale * lw_pi * r2);
    sum.radius = std::sqrt(r2);
    return sum;
}

TEST(Estimate, ExactModeEqualsBruteForce) {
    const Baked baked("cornell.gltf");
    const PhotonEstimator estimator(baked.scene, baked.map, baked.weights, {0, 50});
    int compared = 0;
    for (size_t i = 0; i < baked.photons.records.size(); i += 997) {
        const Photon& p = baked.photons.records[i];
        const Surface s = estimator.surface_at(p.triangle, {0.31f, 0.27f});
        const uint map = baked.map.behind_cuts(baked.map.grid_of_side[2 * p.triangle + p.side()], s.position);
        const float side = p.side() ? -1.0f : 1.0f;
        if (map == no_grid) continue;  // a piece that no photon reaches
        const Gathered got = estimator.gather_photons(estimator.place_on_grid(map, s.position), s,
                                                      s.geometric_normal * side, s.normal * side, s.normal * side);
        const Gathered expected = brute_force(baked, map, s.position, 50);
        EXPECT_NEAR(got.radius, expected.radius, 1e-5f * expected.radius);
        EXPECT_NEAR(got.irradiance.y, expected.irradiance.y, 1e-4f * expected.irradiance.y + 1e-6f);
        ++compared;
    }
    EXPECT_GT(compared, 150);
}

TEST(Estimate, IntegratingSphereReadsItsIlluminance) {
    const Baked baked("sphere.gltf", 400000);
    for (const uint mode : {0u, 1u}) {
        const PhotonEstimator estimator(baked.scene, baked.map, baked.weights, {mode, 100});
        double sum = 0;
        int count = 0;
        for (uint t = 0; t < baked.scene.triangles.size(); t += 7, ++count) {
            const Surface s = estimator.surface_at(t, {1 / 3.0f, 1 / 3.0f});
            const vec3 inward = dot(s.geometric_normal, s.position) > 0 ? -s.geometric_normal : s.geometric_normal;
            sum += double(estimator.estimate(t, {1 / 3.0f, 1 / 3.0f}, inward).irradiance.y);
        }
        EXPECT_NEAR(sum / count / 200, 1, 0.015) << "mode " << mode;
    }
}

TEST(Estimate, InteriorOfTheCubeAgreesWithThePathTracer) {
    const Baked baked("cube.gltf", 1000000);
    const PathTracer tracer(baked.scene, baked.caster, baked.weights);
    for (const uint mode : {0u, 1u}) {
        const PhotonEstimator estimator(baked.scene, baked.map, baked.weights, {mode, 200});
        double map_sum = 0, truth_sum = 0;
        for (uint t = 0; t < baked.scene.triangles.size(); ++t)
            for (int i = 0; i < 20; ++i) {
                Rng place(4, t, uint64_t(i));
                const float a = 0.2f + 0.4f * place.next(), b = 0.2f + 0.2f * place.next();
                const Surface s = estimator.surface_at(t, {a, b});
                const vec3 inward = dot(s.geometric_normal, s.position) > 0 ? -s.geometric_normal : s.geometric_normal;
                map_sum += double(estimator.estimate(t, {a, b}, inward).irradiance.y);
                for (int n = 0; n < 200; ++n) truth_sum += double(tracer.irradiance(s.position, inward, place).y) / 200;
            }
        EXPECT_NEAR(map_sum / truth_sum, 1, 0.01) << "mode " << mode;
    }
}

TEST(Estimate, ExactDirectLightOfAPointLampFollowsTheInverseSquareAndCosineLaws) {
    const Scene scene = load_gltf(file_in_data("cube.gltf"));
    const Bvh bvh = build_bvh(scene);
    PhotonMap dark;
    dark.grid_of_side.assign(2 * scene.triangles.size(), no_grid);
    dark.settings.radius = 1;
    const std::vector<vec3> weights = lamp_powers(scene, {});
    const PhotonEstimator estimator(scene, dark, weights, {}, bvh);
    for (uint t = 0; t < scene.triangles.size(); ++t)
        for (const vec2 place : {vec2(0.2f, 0.2f), vec2(0.05f, 0.9f), vec2(0.5f, 0.5f)}) {
            const Surface s = estimator.surface_at(t, place);
            const vec3 path = scene.lights[0].position - s.position;
            const float expected = 100 * abs(dot(normalize(path), s.geometric_normal)) / dot(path, path);
            EXPECT_NEAR(estimator.estimate(t, place, normalize(path)).irradiance.y, expected, 1e-4f * expected);
            EXPECT_EQ(estimator.estimate(t, place, -normalize(path)).irradiance.y, 0) << "light through a wall";
        }
}

TEST(Estimate, ShadowRaysAgreeWithEmbree) {
    const Scene scene = load_gltf(file_in_data("apartment.glb"));
    const RayCaster caster(scene);
    const Bvh bvh = build_bvh(scene);
    const PhotonMap none;
    const std::vector<vec3> weights;
    const PhotonEstimator estimator(scene, none, weights, {}, bvh);
    Rng rng(5, 1, 1);
    int blocked = 0, different = 0;
    constexpr int rays = 20000;
    for (int i = 0; i < rays; ++i) {
        const auto inside = [&] {
            return mix(scene.bounds[0], scene.bounds[1], vec3(rng.next(), rng.next(), rng.next()));
        };
        const vec3 from = inside(), to = inside();
        const float far = length(to - from);
        const bool open = estimator.shadow_ray(from, (to - from) / far, far - scene.ray_epsilon()).x > 0;
        blocked += !open;
        different += open != (caster.transmittance(from, to).x > 0);
    }
    EXPECT_GT(blocked, rays / 10);
    EXPECT_LT(blocked, rays * 9 / 10);
    EXPECT_LE(different, rays / 2000);  // rays that graze an edge
}

TEST(Estimate, WhatNodesSeeOfALampSavesRaysButChangesNoLight) {
    const Scene scene = load_gltf(file_in_data("cornell.gltf"));
    const RayCaster caster(scene);
    const PhotonMap known = bake(scene, caster, {.photons = 20000});
    ASSERT_TRUE(known.has_visible_lamps());
    PhotonMap unknown = known;
    unknown.visible_lamps.clear();
    const Bvh bvh = build_bvh(scene);
    const std::vector<vec3> weights = lamp_powers(scene, {});
    const PhotonEstimator some_rays(scene, known, weights, {gather_mode_smooth, 50, 4}, bvh);
    const PhotonEstimator all_rays(scene, unknown, weights, {gather_mode_smooth, 50, 4}, bvh);
    Rng rng(3, 1, 1);
    int different = 0, compared = 0;
    for (uint t = 0; t < scene.triangles.size(); ++t)
        for (int i = 0; i < 100; ++i) {
            const vec2 place = sample_triangle(rng.next(), rng.next());
            const vec3 n = all_rays.surface_at(t, place).geometric_normal;
            const float expected = all_rays.estimate(t, place, n, uint(i)).irradiance.y;
            different += std::abs(some_rays.estimate(t, place, n, uint(i)).irradiance.y - expected) > 0.01f * expected;
            ++compared;
        }
    EXPECT_LE(different, compared / 50);
}

struct Difference {
    double bias, rmse;  // of illuminance, over its mean
};

/// On points of all surfaces by area.
Difference compare_everywhere(const PhotonEstimator& got, const PhotonEstimator& expected, const Scene& scene) {
    Rng rng(3, 1, 1);
    double error2 = 0, error = 0, sum = 0;
    int count = 0;
    for (uint t = 0; t < scene.triangles.size(); ++t) {
        const auto area = float(triangle_area(scene, t));
        for (int i = 0; i < int(20 * area + rng.next()); ++i) {
            const vec2 place = sample_triangle(rng.next(), rng.next());
            const vec3 n = got.surface_at(t, place).geometric_normal;
            const double wanted = double(expected.estimate(t, place, n).irradiance.y),
                         off = double(got.estimate(t, place, n).irradiance.y) - wanted;
            error2 += off * off, error += off, sum += wanted;
            ++count;
        }
    }
    EXPECT_GT(sum, 0);
    return {error / sum, std::sqrt(error2 / count) / (sum / count)};
}

TEST(Estimate, LightOfCellsHoldsSmallLampsAsTheyAre) {
    RoomSettings room;
    room.triangles = 2000;
    room.lights = 5;
    room.lamps = Lamps::points;
    const Scene scene = make_room(room);
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 300000});
    PhotonMap by_rays = map;
    by_rays.visible_lamps.clear();  // then every lamp is looked at from every point
    const Bvh bvh = build_bvh(scene);
    const std::vector<vec3> weights = lamp_powers(scene, {});
    const PhotonEstimator from_cells(scene, map, weights, {}, bvh), exact(scene, by_rays, weights, {}, bvh);
    const LatticeLight cells(scene, map);
    const uint lamps = uint(scene.lights.size()), length = lattice_row_length(lamps, map.has_marks()),
               marks = length - lattice_lamp_columns(lamps);
    size_t held = 0;
    for (size_t cell = 0; cell < map.coverage.size(); ++cell)
        for (uint column = marks; column < length; ++column)
            held += lamps_with(cells.rows()[cell * length + column], in_lattice_light) != 0;
    EXPECT_GT(held, map.coverage.size() / 4);
    const Difference difference = compare_everywhere(from_cells, exact, scene);
    EXPECT_LT(std::abs(difference.bias), 0.003);
    EXPECT_LT(difference.rmse, 0.02);

    PhotonMap without_masks = map;
    without_masks.shadow_masks.clear();
    const GatherSettings no_rays{gather_mode_cached, 300, 0};
    const PhotonEstimator by_masks(scene, map, weights, no_rays, bvh),
        by_nodes(scene, without_masks, weights, no_rays, bvh);
    const Difference masks = compare_everywhere(by_masks, exact, scene),
                     nodes = compare_everywhere(by_nodes, exact, scene);
    EXPECT_LT(std::abs(masks.bias), 0.003);
    EXPECT_LT(masks.rmse, 0.03);
    EXPECT_LT(masks.rmse, 0.7 * nodes.rmse);  // nodes at borders, drawn in, see what stands there
}

TEST(Estimate, ReferencesPerPhotonStayBounded) {
    for (const char* name : {"cornell.gltf", "sphere.gltf", "cube.gltf"}) {
        const Baked baked(name);
        EXPECT_LE(double(baked.map.places.size()) / double(baked.map.stored_photons), 2.5) << name;
    }
}

}  // namespace
}  // namespace lw
