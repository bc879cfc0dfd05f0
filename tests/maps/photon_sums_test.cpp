// Kernel sums over the photons of one map, against the sum over all of its records one by one.
#include "maps/photon_sums.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "maps/fill_grid.h"

namespace lw {
namespace {

constexpr uint lamps = 3;

/// A map of one grid, 4 x 2 m, over wavy ground and a second sheet 10 cm above it; a third of the photons lie at one
/// place.
struct Sheets {
    explicit Sheets(size_t count) {
        for (size_t i = 0; i < count; ++i) {
            Rng rng(1, 1, i);
            const bool dense = i % 3 == 0;
            const float x = dense ? 1 + 0.05f * rng.next() : 4 * rng.next(),
                        z = dense ? 0.7f + 0.05f * rng.next() : 2 * rng.next();
            const float y = 0.02f * std::sin(5 * x) + (rng.next() < 0.3f ? 0.1f : 0.0f);
            const vec3 flux = 10.0f * vec3(rng.next(), rng.next(), rng.next());
            photons.push_back(
                {vec3(x, y, z), flux, vec3(0, 1, 0), 0, pack_origin(uint(i) % lamps, path_direct, false)});
        }
        map.settings.radius = 0.5f;
        map.places.resize(count), map.fluxes.resize(count);
        SurfaceGrid& grid = map.grids.emplace_back();
        grid.u_axis = vec3(0, 0, 1), grid.v_axis = vec3(1, 0, 0), grid.normal = vec3(0, 1, 0);
        grid.radius = map.settings.radius;
        std::vector<uint> all(count);
        std::iota(all.begin(), all.end(), 0u);
        map.cell_starts = fill_grid(grid, photons, all, 0, map).cell_starts;
        map.cell_starts.push_back(uint(count));
    }

    /// Flux x (1 - d2 / r2) of each lamp, photon after photon.
    std::array<glm::dvec3, lamps> sum_all(vec3 local, float radius) const {
        std::array<glm::dvec3, lamps> sums{};
        for (size_t i = 0; i < map.places.size(); ++i) {
            const vec3 d = place_in_grid(map.places[i], map.grids[0]) - local;
            const double weight = 1 - double(dot(d, d)) / (double(radius) * double(radius));
            if (weight > 0 && on_same_surface(d.z, dot(d, d), map.grids[0].radius))
                sums[light_of(map.places[i])] += weight * glm::dvec3(unpack_rgb9e5(map.fluxes[i]));
        }
        return sums;
    }

    std::vector<Photon> photons;
    PhotonMap map;
};

/// Sums of each lamp, and the largest difference from what they should be, relative to the largest of them.
double error_at(const Sheets& sheets, const PhotonSums& sums, vec3 local, float radius) {
    std::vector<vec4> parts(PhotonSums::sums_per_lamp * lamps, vec4(0));
    sums.add(local, radius, parts);
    const std::array<glm::dvec3, lamps> expected = sheets.sum_all(local, radius);
    double error = 0, largest = 1e-6;
    for (uint lamp = 0; lamp < lamps; ++lamp) {
        glm::dvec3 got(0);
        for (size_t k = 0; k < PhotonSums::sums_per_lamp; ++k)
            got += glm::dvec3(parts[PhotonSums::sums_per_lamp * lamp + k]);
        error = std::max(error, glm::length(got - expected[lamp]));
        largest = std::max(largest, glm::length(expected[lamp]));
    }
    return error / largest;
}

TEST(PhotonSums, AreThoseOfAllRecordsOneByOne) {
    const Sheets sheets(30'000);
    const PhotonSums sums(sheets.map, sheets.map.grids[0]);
    Rng rng(1, 2, 1);
    for (int i = 0; i < 200; ++i) {
        const vec3 local(3 * rng.next() - 0.5f, 5 * rng.next() - 0.5f, 0.15f * rng.next() - 0.02f);
        const float radius = 0.02f + 0.48f * rng.next();
        ASSERT_LT(error_at(sheets, sums, local, radius), 2e-5) << local.x << " " << local.y << ", radius " << radius;
    }
}

TEST(PhotonSums, AreExactWhereThousandsLieInOneRowOfCells) {
    const Sheets sheets(60'000);
    const PhotonSums sums(sheets.map, sheets.map.grids[0]);
    const vec3 crowd = vec3(0.72f, 1.02f, 0) - vec3(dot(sheets.map.grids[0].origin, sheets.map.grids[0].u_axis),
                                                    dot(sheets.map.grids[0].origin, sheets.map.grids[0].v_axis), 0);
    const std::array<glm::dvec3, lamps> expected = sheets.sum_all(crowd, 0.1f);
    ASSERT_GT(expected[0].x, 5000 * 1.0);
    EXPECT_LT(error_at(sheets, sums, crowd, 0.1f), 1e-6);
}

TEST(PhotonSums, AreAddedToWhatIsThere) {
    const Sheets sheets(3'000);
    const PhotonSums sums(sheets.map, sheets.map.grids[0]);
    std::vector<vec4> once(PhotonSums::sums_per_lamp * lamps, vec4(0)), twice = once;
    sums.add(vec3(1, 2, 0), 0.3f, once);
    for (int i = 0; i < 2; ++i) sums.add(vec3(1, 2, 0), 0.3f, twice);
    double total = 0;
    for (size_t k = 0; k < once.size(); ++k) {
        total += double(once[k].x);
        EXPECT_NEAR(twice[k].x, 2 * once[k].x, 1e-5f * once[k].x);
    }
    EXPECT_GT(total, 0);
}

TEST(PhotonSums, AreNothingFarFromAllPhotons) {
    const Sheets sheets(3'000);
    const PhotonSums sums(sheets.map, sheets.map.grids[0]);
    for (vec3 local : {vec3(-3, 1, 0), vec3(1, 9, 0), vec3(1, 2, 3)}) {
        std::vector<vec4> parts(PhotonSums::sums_per_lamp * lamps, vec4(0));
        sums.add(local, 0.5f, parts);
        for (const vec4& part : parts) EXPECT_EQ(part, vec4(0));
    }
}

/// Equal terms are the worst for a sum in floats: every addition is rounded the same way.
TEST(PhotonSums, OfAMillionPhotonsAtOnePlaceAreExact) {
    constexpr size_t count = 1'000'000;
    const Photon photon{vec3(1, 0, 1), vec3(1.1f), vec3(0, 1, 0), 0, pack_origin(0, path_direct, false)};
    PhotonMap map;
    map.places.resize(count), map.fluxes.resize(count);
    SurfaceGrid& grid = map.grids.emplace_back();
    grid.u_axis = vec3(0, 0, 1), grid.v_axis = vec3(1, 0, 0), grid.normal = vec3(0, 1, 0);
    grid.radius = 0.5f;
    map.cell_starts = fill_grid(grid, {photon}, std::vector<uint>(count, 0), 0, map).cell_starts;
    map.cell_starts.push_back(uint(count));
    std::vector<vec4> parts(PhotonSums::sums_per_lamp, vec4(0));
    PhotonSums(map, grid).add(position_in_grid(grid, photon.position), 0.5f, parts);
    double sum = 0;
    for (const vec4& part : parts) sum += double(part.x);
    EXPECT_NEAR(sum / (count * double(unpack_rgb9e5(map.fluxes[0]).x)), 1, 1e-4);
}

}  // namespace
}  // namespace lw
