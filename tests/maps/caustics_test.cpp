// The maps of caustics against light counted from the lamp, and where they must not be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maps/build.h"
#include "maps/estimate.h"
#include "photons/shoot.h"
#include "scene/gltf.h"
#include "shaders/color.h"
#include "trace/build_bvh.h"
#include "trace/caustics.h"
#include "trace/emitter.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

struct Baked {
    Baked(const std::string& name, uint64_t count, float radius = 0)
        : scene(load_gltf(file_in_data(name))),
          caster(scene),
          photons(shoot_photons(scene, caster, {.photons = count})),
          map(build_photon_map(scene, caster, photons, {.photons = count, .radius = radius})) {}
    Scene scene;
    RayCaster caster;
    Photons photons;
    PhotonMap map;
};

TEST(CausticMap, ASceneWithoutMirrorsAndGlassHasNone) {
    const Baked cornell("cornell.gltf", 50000);
    EXPECT_EQ(cornell.map.caustic_grids, 0u);
    EXPECT_TRUE(cornell.map.caustic_sides.empty());
}

TEST(CausticMap, HoldsEveryCausticPhotonAndNoOther) {
    const Baked baked("glass_sphere.gltf", 100000);
    ASSERT_GT(baked.map.caustic_grids, 0u);
    EXPECT_FALSE(baked.map.caustic_sides.empty());
    const uint others = uint(baked.map.grids.size()) - baked.map.caustic_grids;
    for (uint g = 0; g < baked.map.grids.size(); ++g) {
        const SurfaceGrid& grid = baked.map.grids[g];
        const uint end = baked.map.cell_starts[grid.first_cell + grid.columns * grid.rows];
        for (uint i = baked.map.cell_starts[grid.first_cell]; i < end; ++i)
            ASSERT_EQ(is_caustic(path_of(baked.map.places[i])), g >= others);
    }
    const auto in_caustics = [](const Photon& p) { return is_caustic(p.path()); };
    const auto stored = std::count_if(baked.photons.records.begin(), baked.photons.records.end(), in_caustics);
    const SurfaceGrid& first = baked.map.grids[others];
    EXPECT_GE(long(baked.map.places.size()) - long(baked.map.cell_starts[first.first_cell]), stored);
}

/// Lux of caustic light on squares of the floor of a side `side` m around its middle: truth by counting, then the
/// map's.
struct FloorLight {
    static constexpr int squares = 20;
    FloorLight(const Baked& baked, uint lamp, float side) : truth(squares * squares), got(squares * squares) {
        std::vector<vec3> weights(baked.scene.lights.size(), vec3(0));
        weights[lamp] = baked.scene.lights[lamp].intensity;
        const vec3 origin(baked.scene.origin);
        const double area = double(side) * double(side) / (squares * squares);
        constexpr uint64_t paths = 4000000;
        const Caustics light(baked.scene, baked.caster, weights, {paths, 0.01f, 3, 0});
        for (const Caustics::Arrival& a : light.arrivals()) {
            const vec3 at = a.position + origin;
            const int x = int(std::floor((at.x / side + 0.5f) * squares)),
                      z = int(std::floor((at.z / side + 0.5f) * squares));
            if (at.y > 1e-3f || a.normal.y < 0.9f || x < 0 || z < 0 || x >= squares || z >= squares) continue;
            truth[size_t(z * squares + x)] += precise_luminance(a.flux) / area;
        }
        const PhotonEstimator estimator(baked.scene, baked.map, weights, {});
        constexpr int fine = 8;
        for (int z = 0; z < squares * fine; ++z)
            for (int x = 0; x < squares * fine; ++x) {
                const vec3 at((float(x) + 0.5f) / (squares * fine) * side - 0.5f * side, 0.1f,
                              (float(z) + 0.5f) / (squares * fine) * side - 0.5f * side);
                const auto hit = baked.caster.nearest(at - origin, vec3(0, -1, 0));
                const Surface s = estimator.surface_at(hit->triangle, hit->barycentrics);
                Gathered sum{};
                const auto place = estimator.place_on_grid(estimator.grid_of(hit->triangle, true), s.position);
                estimator.add_caustics(hit->triangle, true, 1, place, s, s.geometric_normal, s.normal, vec3(0, 1, 0),
                                       sum);
                got[size_t(z / fine * squares + x / fine)] += precise_luminance(sum.irradiance) / (fine * fine);
            }
    }
    std::vector<double> truth, got;
};

TEST(CausticMap, ShowsTheFocusOfAGlassBall) {
    const Baked baked("glass_sphere.gltf", 1000000);
    uint spot = 0;
    while (baked.scene.light_names[spot] != "spot") ++spot;
    const FloorLight light(baked, spot, 0.16f);
    double sum = 0, brightest = 0, got = 0, error2 = 0;
    size_t lit = 0;
    for (size_t i = 0; i < light.truth.size(); ++i) {
        sum += light.truth[i], got += light.got[i];
        brightest = std::max(brightest, light.truth[i]);
    }
    for (size_t i = 0; i < light.truth.size(); ++i) {
        if (light.truth[i] < 0.05 * brightest) continue;
        ++lit;
        error2 += std::pow(light.got[i] - light.truth[i], 2);
    }
    const double mean = sum / double(light.truth.size());
    EXPECT_GT(brightest, 5 * mean);  // a focus, not a veil
    ASSERT_GT(lit, 10u);
    double lit_sum = 0;
    for (double e : light.truth) lit_sum += e >= 0.05 * brightest ? e : 0;
    EXPECT_LT(std::sqrt(error2 / double(lit)) / (lit_sum / double(lit)), 0.1);
    EXPECT_NEAR(got / sum, 1, 0.03);  // the kernels on the dark side of a sharp rim reach into the light
}

/// The same map with all caustics left to the pixels.
PhotonMap without_caustics_in_cells(const Baked& baked) {
    Photons others = baked.photons;
    std::erase_if(others.records, [](const Photon& p) { return is_caustic(p.path()); });
    const BakeSettings settings = baked.map.settings;
    const PhotonMap plain = build_photon_map(baked.scene, baked.caster, others, settings);
    PhotonMap map = baked.map;
    map.smooth_caustics.clear();
    map.irradiance = plain.irradiance;
    map.irradiance_scale = plain.irradiance_scale;
    return map;
}

TEST(CausticMap, TheLightOfCellsHoldsSmoothCausticsAsThePixelsGatherThem) {
    const Baked baked("glass_sphere.gltf", 300000, 0.083f);  // so fine that some caustics are smooth for its lattice
    const PhotonMap gathered = without_caustics_in_cells(baked);
    ASSERT_EQ(gathered.irradiance.marks.size(), baked.map.irradiance.marks.size());
    std::vector<vec3> weights;
    for (const Light& light : baked.scene.lights) weights.push_back(light.intensity);
    const PhotonEstimator held(baked.scene, baked.map, weights, {}), full(baked.scene, gathered, weights, {});
    double sum = 0, error = 0, error2 = 0, caustic = 0;
    int points = 0, sharp = 0, smooth = 0;
    const float side = 0.5f;
    constexpr int across = 60;
    for (int i = 0; i < across * across; ++i) {  // the floor under the ball, focus and surroundings
        const vec3 at(side * (float(i % across) / across - 0.5f), 0.05f, side * (float(i / across) / across - 0.5f));
        const auto hit = baked.caster.nearest(at - vec3(baked.scene.origin), vec3(0, -1, 0));
        ASSERT_TRUE(hit);
        const Surface s = held.surface_at(hit->triangle, hit->barycentrics);
        const auto seen = held.see(hit->triangle, hit->barycentrics, s.position + s.geometric_normal);
        if (seen.at.index == no_grid || held.caustic_grid_of(hit->triangle, seen.front) == no_grid) continue;
        const float left = held.caustics_left(seen.at);
        const double got = precise_luminance(held.estimate_at(seen).irradiance),
                     wanted = precise_luminance(full.estimate_at(seen).irradiance);
        Gathered own = held.no_light();
        full.add_caustics(hit->triangle, seen.front, 1, seen.at, s, seen.n_geometric, seen.n_shading, seen.to_eye, own);
        caustic += precise_luminance(own.irradiance);
        ++points, sharp += left == 1, smooth += left == 0;
        sum += wanted, error += got - wanted, error2 += (got - wanted) * (got - wanted);
    }
    ASSERT_GT(sharp, 0);
    ASSERT_GT(smooth, points / 4);
    EXPECT_GT(caustic, 0.1 * sum);
    EXPECT_LT(std::abs(error), 0.004 * sum);
    EXPECT_LT(std::sqrt(error2 / points), 0.015 * sum / points);
}

}  // namespace
}  // namespace lw
