// Photons brought into the grid of their map: each in its cell, where it was, as bright as it was.
#include "maps/fill_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/random.h"
#include "maps/packing.h"

namespace lw {
namespace {

/// Photons on a tilted strip of 3 x 0.5 m, some of which its map refers to.
struct Strip {
    explicit Strip(size_t count, bool has_directions = true) {
        Rng rng(1, 1, count);
        frame.u_axis = normalize(vec3(1, 0.5f, 0.2f));
        frame.normal = normalize(cross(frame.u_axis, vec3(0, 0, -1)));
        frame.v_axis = cross(frame.normal, frame.u_axis);
        frame.origin = vec3(20, -3, 7);
        frame.radius = 0.2f;
        for (size_t i = 0; i < count; ++i) {
            const vec3 local(3 * rng.next() - 1, 0.5f * rng.next(), 0.02f * rng.next());
            const vec3 position =
                frame.origin + frame.u_axis * local.x + frame.v_axis * local.y + frame.normal * local.z;
            const vec3 from = normalize(vec3(rng.next() - 0.5f, rng.next() - 0.5f, rng.next() - 0.5f));
            photons.push_back({position, vec3(rng.next(), rng.next(), 1), from, uint(i),
                               pack_origin(uint(i % 7), uint(i % 4), i % 2 == 1)});
            if (i % 3 != 0) chosen.push_back(uint(i));
        }
        map.flux_scale = 16;
        map.places.resize(begin + chosen.size() + 2), map.fluxes.resize(map.places.size());
        if (has_directions) map.directions.resize(map.places.size());
        grid = frame;
        starts = fill_grid(grid, photons, chosen, begin, map).cell_starts;
    }
    uint end_of(size_t cell) const { return cell + 1 < starts.size() ? starts[cell + 1] : begin + uint(chosen.size()); }

    static constexpr uint begin = 5;
    SurfaceGrid frame{}, grid{};
    std::vector<Photon> photons;
    std::vector<uint> chosen, starts;
    PhotonMap map;
};

vec3 position_of(const SurfaceGrid& grid, PhotonPlace place) {
    const vec3 local = place_in_grid(place, grid);
    return grid.origin + grid.u_axis * local.x + grid.v_axis * local.y + grid.normal * local.z;
}

TEST(FillGrid, CellsStartOneAfterTheOtherAndHoldAllChosenPhotons) {
    const Strip strip(5'000);
    ASSERT_EQ(strip.starts.size(), size_t(strip.grid.columns) * strip.grid.rows);
    EXPECT_EQ(strip.starts[0], Strip::begin);
    EXPECT_TRUE(std::is_sorted(strip.starts.begin(), strip.starts.end()));
    EXPECT_LE(strip.starts.back(), Strip::begin + strip.chosen.size());
    for (uint outside : {0u, Strip::begin - 1, Strip::begin + uint(strip.chosen.size())})
        EXPECT_EQ(strip.map.fluxes[outside], 0u) << outside;
}

TEST(FillGrid, EveryRecordLiesInItsCell) {
    const Strip strip(5'000);
    for (size_t cell = 0; cell < strip.starts.size(); ++cell)
        for (uint i = strip.starts[cell]; i < strip.end_of(cell); ++i) {
            const vec3 local = place_in_grid(strip.map.places[i], strip.grid);
            const vec2 low =
                strip.grid.cell_size * vec2(float(cell % strip.grid.columns), float(cell / strip.grid.columns));
            const float margin = 1e-4f * strip.grid.cell_size;
            EXPECT_TRUE(local.x >= low.x - margin && local.x <= low.x + strip.grid.cell_size + margin) << i;
            EXPECT_TRUE(local.y >= low.y - margin && local.y <= low.y + strip.grid.cell_size + margin) << i;
        }
}

TEST(FillGrid, CellsAreSquareAndHoldTwoOrThreePhotonsInTheMean) {
    const Strip strip(20'000);
    const double cells = double(strip.starts.size());
    EXPECT_NEAR(double(strip.chosen.size()) / cells, references_per_cell, 0.2);
    EXPECT_NEAR(double(strip.grid.columns) / double(strip.grid.rows), 6, 0.3);
}

/// The records of a map keep what the photons were, in another order: found again by their brightness.
TEST(FillGrid, RecordsKeepPlaceFluxLampAndDirection) {
    const Strip strip(2'000);
    std::multimap<uint, const Photon*> by_flux;
    for (uint i : strip.chosen)
        by_flux.emplace(pack_rgb9e5(strip.photons[i].flux * strip.map.flux_scale), &strip.photons[i]);
    for (uint i = Strip::begin; i < Strip::begin + strip.chosen.size(); ++i) {
        const PhotonPlace place = strip.map.places[i];
        const auto [first, last] = by_flux.equal_range(strip.map.fluxes[i]);
        const auto is_it = [&](const auto& entry) {
            const vec3 error = abs(position_of(strip.grid, place) - entry.second->position);
            return std::max({error.x, error.y, error.z}) < 0.5f * strip.grid.quantum.x + 1e-5f;  // rounding of 20 m
        };
        const auto found = std::find_if(first, last, is_it);
        ASSERT_NE(found, last) << i;
        const Photon& photon = *found->second;
        EXPECT_EQ(light_of(place), photon.light());
        EXPECT_EQ(path_of(place), photon.path());
        EXPECT_GT(dot(unpack_direction(strip.map.directions[i]), photon.from), std::cos(glm::radians(1.9f)));
        by_flux.erase(found);
    }
    EXPECT_TRUE(by_flux.empty());
}

TEST(FillGrid, TheFrameStaysAndItsOriginMovesWithinItsPlane) {
    const Strip strip(1'000);
    EXPECT_EQ(strip.grid.normal, strip.frame.normal);
    EXPECT_EQ(strip.grid.u_axis, strip.frame.u_axis);
    EXPECT_EQ(strip.grid.radius, strip.frame.radius);
    EXPECT_NEAR(dot(strip.grid.origin - strip.frame.origin, strip.frame.normal), 0, 1e-5);
}

TEST(FillGrid, PhotonsAtOnePlaceShareAFewCells) {
    Strip strip(300);
    for (Photon& photon : strip.photons) photon.position = strip.photons[0].position;
    strip.grid = strip.frame;
    strip.starts = fill_grid(strip.grid, strip.photons, strip.chosen, Strip::begin, strip.map).cell_starts;
    EXPECT_LE(strip.starts.size(), 4u);
    for (uint i = Strip::begin; i < Strip::begin + strip.chosen.size(); ++i)
        EXPECT_LT(length(position_of(strip.grid, strip.map.places[i]) - strip.photons[0].position), 1e-4f);
}

TEST(FillGrid, WithoutDirectionsNoneAreKept) {
    const Strip strip(1'000, false);
    EXPECT_TRUE(strip.map.directions.empty());
}

}  // namespace
}  // namespace lw
