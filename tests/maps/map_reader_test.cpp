// Photons around a point, by the map's grids and by a look at every photon there is; and the bandwidths that follow
// from counts.
#include "maps/map_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "maps/build.h"
#include "maps/photons_on_floor.h"

namespace lw {
namespace {

using namespace test;

constexpr float radius = 0.4f;  // m

/// The map of given photons on a floor.
struct FloorMap {
    explicit FloorMap(std::vector<Photon> (*make)(const RayCaster&)) {
        photons.records = make(caster);
        photons.lights.resize(scene.lights.size());
        map = build_photon_map(scene, caster, photons, {.radius = radius});
    }
    Scene scene = floor_with_two_lamps();
    RayCaster caster{scene};
    Photons photons;
    PhotonMap map;
};

/// Photons all over the floor by chance, on both of its sides; a third lie at one place.
std::vector<Photon> scattered(const RayCaster& caster) {
    std::vector<Photon> photons;
    for (size_t i = 0; i < 10'000; ++i) {
        Rng rng(1, 1, i);
        vec3 from(6 * rng.next(), 1, 6 * rng.next());
        if (i % 3 == 0) from = vec3(2, 1, 2) + 0.3f * vec3(rng.next(), 0, rng.next());
        photons.push_back(*photon_below(caster, from, uint(i) % 2));
        if (i % 4 == 0) photons.back().origin = pack_origin(uint(i) % 2, path_indirect, true);
    }
    return photons;
}

const FloorMap& scattered_floor() {
    static const FloorMap floor(scattered);
    return floor;
}

std::vector<Photon> in_rows(const RayCaster& caster) { return photons_in_rows(caster, 0, 6, 0.02f, 0, path_indirect); }

uint triangle_at(const FloorMap& floor, vec3 p) {
    return floor.caster.nearest(p + vec3(0, 1, 0), vec3(0, -1, 0))->triangle;
}

TEST(MapReader, VisitsThePhotonsOfTheSameSideWithinTheRadius) {
    const FloorMap& floor = scattered_floor();
    const MapReader reader(floor.map);
    size_t visited = 0;
    for (size_t k = 0; k < 300; ++k) {
        Rng rng(1, 2, k);
        const vec3 p(6 * rng.next(), 0, 6 * rng.next());
        const bool front = k % 2 == 0;
        const auto place = reader.place_on_grid(reader.grid_of(triangle_at(floor, p), front), p);
        ASSERT_NE(place.index, no_grid);
        const float r = place.grid.radius * (0.2f + 0.8f * rng.next());
        size_t fewest = 0, most = 0;  // places are rounded to 16 bits
        for (const Photon& photon : floor.photons.records) {
            if ((photon.side() == 0) != front) continue;
            fewest += length(photon.position - p) < r - 3e-4f;
            most += length(photon.position - p) < r + 3e-4f;
        }
        size_t count = 0;
        reader.visit_photons(place.grid, place.local, r, [&](uint, PhotonPlace photon, float d2) {
            EXPECT_LT(d2, r * r);
            const vec3 at = position_of(place.grid, place_in_grid(photon, place.grid));
            EXPECT_NEAR(length(at - p), std::sqrt(d2), 1e-4f);
            ++count;
        });
        EXPECT_GE(count, fewest) << k;
        EXPECT_LE(count, most) << k;
        visited += count;
    }
    EXPECT_GT(visited, 5'000u);
}

TEST(MapReader, FindsThePlaceOfAPointInItsGridAndLattice) {
    const FloorMap& floor = scattered_floor();
    const MapReader reader(floor.map);
    for (size_t k = 0; k < 300; ++k) {
        Rng rng(1, 3, k);
        const vec3 p(6 * rng.next(), 0, 6 * rng.next());
        const uint triangle = triangle_at(floor, p);
        const auto place = reader.place_on_grid(reader.grid_of(triangle, true), p);
        EXPECT_EQ(place.index, floor.map.grid_of_side[2 * triangle]);
        EXPECT_LT(length(position_of(place.grid, place.local) - p), 1e-5f);
        const SurfaceLattice& lattice = place.grid.lattice;
        const uint i = place.cell - lattice.first_node;
        const vec2 node(float(i % lattice.columns), float(i / lattice.columns));
        EXPECT_LT(length(lattice.low + (node + place.f) * lattice.step - vec2(place.local)), 1e-4f);
        EXPECT_TRUE(i % lattice.columns + 1 < lattice.columns && i / lattice.columns + 1 < lattice.rows);
    }
}

TEST(MapReader, FindsNoPlaceWhereThereIsNoGrid) {
    const FloorMap floor(in_rows);
    const MapReader reader(floor.map);
    EXPECT_EQ(reader.grid_of(0, false), no_grid);
    EXPECT_EQ(reader.place_on_grid(reader.grid_of(0, false), vec3(1, 0, 5)).index, no_grid);
}

TEST(MapReader, BandwidthHoldsTheWantedNumberOfEvenPhotons) {
    const FloorMap floor(in_rows);
    for (const uint wanted : {50u, 200u, 800u}) {
        const MapReader reader(floor.map, wanted);
        const double expected = 0.02 * std::sqrt(wanted / M_PI);
        for (const vec3 p : {vec3(2, 0, 4), vec3(4.3f, 0, 1.7f), vec3(1.1f, 0, 4.5f)}) {
            const auto place = reader.place_on_grid(reader.grid_of(triangle_at(floor, p), true), p);
            EXPECT_NEAR(double(reader.bandwidth_from_counts(place.grid, place.local)) / expected, 1, 0.06) << wanted;
        }
    }
    const MapReader reader(floor.map, 5'000);  // more than lie within the search radius
    const auto place = reader.place_on_grid(reader.grid_of(0, true), vec3(2, 0, 4));
    EXPECT_EQ(reader.bandwidth_from_counts(place.grid, place.local), place.grid.radius);
}

TEST(MapReader, TheKernelOfCausticsHolds120Photons) {
    const FloorMap floor(in_rows);
    const MapReader reader(floor.map);
    const auto place = reader.place_on_grid(reader.grid_of(0, true), vec3(2, 0, 4));
    const double expected = 0.02 * std::sqrt(double(caustic_neighbours) / M_PI);
    EXPECT_NEAR(double(reader.caustic_radius(place.grid, place.local)) / expected, 1, 0.06);
    EXPECT_EQ(reader.caustic_radius(place.grid, place.local + vec3(100, 0, 0)), place.grid.radius);
}

TEST(MapReader, CoverageIsOneInTheMiddleAndHalfAtAnEdge) {
    const FloorMap floor(in_rows);
    const MapReader reader(floor.map);
    const auto covered_at = [&](vec3 p) {
        const auto place = reader.place_on_grid(reader.grid_of(triangle_at(floor, p), true), p);
        return reader.covered_part(place, radius);
    };
    EXPECT_NEAR(covered_at(vec3(2, 0, 4)), 1, 0.01f);
    EXPECT_NEAR(covered_at(vec3(2, 0, 5.999f)), 0.5f, 0.03f);
    PhotonMap unknown = floor.map;
    unknown.coverage.clear();
    const MapReader without(unknown);
    const auto place = without.place_on_grid(without.grid_of(0, true), vec3(2, 0, 5.999f));
    EXPECT_EQ(without.covered_part(place, radius), 1);
}

/// A grid of 3 x 2 cells of 1 m with 1, 2, ... 6 photons in its cells.
struct SixCells {
    SixCells() {
        grid.cell_size = 1, grid.columns = 3, grid.rows = 2, grid.radius = 4;
        grid.u_axis = vec3(1, 0, 0), grid.v_axis = vec3(0, 0, 1), grid.normal = vec3(0, 1, 0);
        records.cell_starts = {0, 1, 3, 6, 10, 15, 21};
    }
    SurfaceGrid grid{};
    PhotonRecords records;
    GridReader reader{records};
};

TEST(GridReader, RowsAreClippedToTheGrid) {
    const SixCells six;
    EXPECT_EQ(six.reader.row_span(six.grid, 0, 1, 0), uvec2(0, 3));
    EXPECT_EQ(six.reader.row_span(six.grid, -5, 0, 1), uvec2(6, 10));
    EXPECT_EQ(six.reader.row_span(six.grid, 2, 9, 1), uvec2(15, 21));
    for (const glm::ivec3 outside : {glm::ivec3(0, 2, -1), {0, 2, 2}, {3, 9, 0}, {-9, -1, 0}}) {
        const uvec2 span = six.reader.row_span(six.grid, outside.x, outside.y, outside.z);
        EXPECT_EQ(span.x, span.y) << outside.x << " " << outside.z;
    }
}

TEST(GridReader, RingsBeginWhereTheyMeetTheGridAndEndWhereTheyCoverIt) {
    const SixCells six;
    EXPECT_EQ(six.reader.grid_cell_of(vec3(1.5f, -0.1f, 0), six.grid), ivec2(1, -1));
    EXPECT_EQ(six.reader.first_ring(six.grid, ivec2(1, 1)), 0);
    EXPECT_EQ(six.reader.first_ring(six.grid, ivec2(-2, 1)), 2);
    EXPECT_EQ(six.reader.first_ring(six.grid, ivec2(7, 3)), 5);
    EXPECT_FALSE(six.reader.covers_grid(six.grid, ivec2(0, 0), 1));
    EXPECT_TRUE(six.reader.covers_grid(six.grid, ivec2(0, 0), 2));
    EXPECT_TRUE(six.reader.covers_grid(six.grid, ivec2(1, 0), 1));
}

}  // namespace
}  // namespace lw
