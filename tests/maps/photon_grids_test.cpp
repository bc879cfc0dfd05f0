// Photons in the grids of their patches: each where it belongs, in the cell its place falls in, and no other.
#include "maps/photon_grids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "maps/photons_on_floor.h"
#include "maps/places_in_room.h"

namespace lw {
namespace {

using namespace test;

/// Photons in a room that can be told apart: each is of a lamp of its own number.
std::vector<Photon> named_places_in(const RoomPatches& room) {
    std::vector<Photon> photons = places_in(room, 5'000);
    for (uint i = 0; i < photons.size(); ++i) {
        photons[i].origin = pack_origin(i, i % 2 ? path_indirect : path_direct, photons[i].side() == 1);
        photons[i].flux = vec3(1, 0.5f, float(i % 7));
        photons[i].from = normalize(vec3(1, float(i % 5), -1));
    }
    return photons;
}

/// A furnished room whose photons lie in their grids.
struct SortedRoom {
    ReferenceInput input() const { return {room.scene, caster, room.partition, photons}; }

    const RoomPatches& room = furnished_room();
    RayCaster caster{room.scene};
    std::vector<Photon> photons = named_places_in(room);
    PhotonGrids grids = sort_into_grids(input(), {.flux_scale = 4, .directions = true});
};

const SortedRoom& sorted_room() {
    static const SortedRoom room;
    return room;
}

/// Calls visit(grid, its number, cell, reference) for all references.
template <class Visit>
void for_each_reference(const SurfaceGrids& surfaces, const PhotonRecords& records, const Visit& visit) {
    for (size_t m = 0; m < surfaces.grids.size(); ++m) {
        const SurfaceGrid& grid = surfaces.grids[m];
        for (uint cell = 0; cell < grid.columns * grid.rows; ++cell)
            for (uint i = records.cell_starts[grid.first_cell + cell];
                 i < records.cell_starts[grid.first_cell + cell + 1]; ++i)
                visit(grid, m, cell, i);
    }
}

TEST(PhotonGrids, HoldEachPhotonOnceForEveryPatchThatRefersToIt) {
    const SortedRoom& s = sorted_room();
    std::vector<std::multiset<uint>> expected(s.room.partition.patches.count), got(expected.size());
    const PatchFinder finder(s.input());
    for (uint i = 0; i < s.photons.size(); ++i) {
        std::vector<NeighbourReference> found;
        if (finder.find(i, finder.own_patch(i), found)) expected[finder.own_patch(i)].insert(i);
        for (const NeighbourReference& reference : found) expected[reference.patch].insert(i);
    }
    for_each_reference(s.grids.surfaces, s.grids.records, [&](const SurfaceGrid&, size_t m, uint, uint i) {
        got[s.grids.surfaces.patches[m]].insert(light_of(s.grids.records.places[i]));
    });
    for (size_t p = 0; p < expected.size(); ++p) EXPECT_EQ(got[p], expected[p]) << p;
    EXPECT_TRUE(std::is_sorted(s.grids.surfaces.patches.begin(), s.grids.surfaces.patches.end()));
    EXPECT_EQ(s.grids.records.cell_starts.back(), s.grids.records.places.size());
}

TEST(PhotonGrids, RecordsLieInTheirCellsAndKeepTheirPhotons) {
    const SortedRoom& s = sorted_room();
    const PhotonRecords& records = s.grids.records;
    ASSERT_EQ(records.flux_scale, 4);
    ASSERT_EQ(records.directions.size(), records.places.size());
    size_t count = 0;
    for_each_reference(s.grids.surfaces, records, [&](const SurfaceGrid& grid, size_t, uint cell, uint i) {
        const Photon& photon = s.photons[light_of(records.places[i])];
        const vec3 local = place_in_grid(records.places[i], grid);
        const vec2 low = vec2(float(cell % grid.columns), float(cell / grid.columns)) * grid.cell_size;
        const float rounding = 1e-4f * grid.cell_size;
        EXPECT_TRUE(local.x >= low.x - rounding && local.x <= low.x + grid.cell_size + rounding);
        EXPECT_TRUE(local.y >= low.y - rounding && local.y <= low.y + grid.cell_size + rounding);
        EXPECT_LT(length(position_of(grid, local) - photon.position), length(grid.quantum) + 1e-5f);
        EXPECT_EQ(path_of(records.places[i]), photon.path());
        EXPECT_LT(length(unpack_rgb9e5(records.fluxes[i]) - 4.0f * photon.flux), 0.1f);
        EXPECT_GT(dot(unpack_direction(records.directions[i]), photon.from), 0.999f);
        ++count;
    });
    EXPECT_EQ(count, records.places.size());
}

TEST(PhotonGrids, PointsOfASurfaceLeadToTheGridOfTheirPatch) {
    const SortedRoom& s = sorted_room();
    const SurfaceGrids& surfaces = s.grids.surfaces;
    const Patches& patches = s.room.partition.patches;
    std::vector<uint> grid_of_patch(patches.count, no_grid);
    for (uint m = 0; m < surfaces.grids.size(); ++m) grid_of_patch[s.grids.surfaces.patches[m]] = m;
    ASSERT_GT(surfaces.cuts.size(), 0u);
    size_t without = 0;
    for (const Photon& place : places_in(s.room, 20'000))
        for (uint side : {2 * place.triangle, 2 * place.triangle + 1}) {
            const uint grid = surfaces.behind_cuts(surfaces.grid_of_side[side], place.position);
            EXPECT_EQ(grid, grid_of_patch[patches.at(side, place.position)]) << side;
            without += grid == no_grid;
        }
    EXPECT_GT(without, 20u);
}

TEST(PhotonGrids, HaveTheFrameOfTheirPatchAndItsRadius) {
    const SortedRoom& s = sorted_room();
    for (size_t m = 0; m < s.grids.surfaces.grids.size(); ++m) {
        const SurfaceGrid& grid = s.grids.surfaces.grids[m];
        const uint patch = s.grids.surfaces.patches[m];
        EXPECT_EQ(grid.normal, s.room.partition.shapes[patch].normal);
        EXPECT_EQ(grid.u_axis, s.room.partition.shapes[patch].u_axis);
        EXPECT_EQ(grid.v_axis, s.room.partition.shapes[patch].v_axis);
        EXPECT_EQ(grid.radius, s.room.partition.radii[patch]);
    }
}

TEST(PhotonGrids, AreNoneWhereNoPhotonIs) {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 6), vec3(6, 0, 0), 0.5f);
    lab.add_rectangle("wall", vec3(3, 0, 0), vec3(0, 3, 0), vec3(0, 0, 6), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    const Partition partition = partition_surfaces(scene, caster, {.radius = 0.25f});
    ASSERT_EQ(partition.patches.cuts.size(), 2u);  // of the upper sides of both triangles of the floor
    const std::vector<Photon> photons{*photon_below(caster, vec3(2.5f, 1, 1), 0)};
    const SurfaceGrids surfaces = sort_into_grids({scene, caster, partition, photons}, {}).surfaces;
    ASSERT_EQ(surfaces.grids.size(), 1u);
    ASSERT_EQ(surfaces.cuts.size(), 1u);
    for (size_t side = 0; side < surfaces.grid_of_side.size(); ++side)
        EXPECT_EQ(surfaces.grid_of_side[side], side == 2 * photons[0].triangle ? cut_bit : no_grid) << side;
    EXPECT_EQ(surfaces.behind_cuts(cut_bit, photons[0].position), 0u);
    EXPECT_EQ(surfaces.behind_cuts(cut_bit, vec3(3.5f, 0, 1)), no_grid);
}

TEST(PhotonGrids, AppendedOnesHoldWhatTheyHeld) {
    const SortedRoom& s = sorted_room();
    std::vector<Photon> some, others;
    for (const Photon& p : s.photons) (p.position.x < 2 ? some : others).push_back(p);
    const RecordSettings settings{.flux_scale = 4, .directions = true};
    PhotonGrids joined = sort_into_grids({s.room.scene, s.caster, s.room.partition, some}, settings);
    const PhotonGrids more = sort_into_grids({s.room.scene, s.caster, s.room.partition, others}, settings);
    const size_t first = joined.surfaces.grids.size(), records = joined.records.places.size();
    const std::vector<uint> of_side = append_grids(more, joined.surfaces, joined.records);
    ASSERT_EQ(joined.surfaces.grids.size(), first + more.surfaces.grids.size());
    ASSERT_EQ(joined.records.cell_starts.back(), joined.records.places.size());
    size_t cells = 0;
    for (const SurfaceGrid& grid : joined.surfaces.grids) {
        EXPECT_EQ(grid.first_cell, cells);
        cells += grid.columns * grid.rows;
    }
    EXPECT_EQ(joined.records.cell_starts.size(), cells + 1);
    size_t before = 0, behind = 0;
    for_each_reference(joined.surfaces, joined.records, [&](const SurfaceGrid& grid, size_t m, uint, uint i) {
        const Photon& photon = s.photons[light_of(joined.records.places[i])];
        EXPECT_EQ(photon.position.x < 2, m < first);
        EXPECT_LT(length(position_of(grid, place_in_grid(joined.records.places[i], grid)) - photon.position),
                  length(grid.quantum) + 1e-5f);
        ++(m < first ? before : behind);
    });
    EXPECT_EQ(before, records);
    EXPECT_EQ(behind, more.records.places.size());
    for (const Photon& p : others) {
        const uint side = 2 * p.triangle + p.side();
        const uint in_more = more.surfaces.behind_cuts(more.surfaces.grid_of_side[side], p.position);
        const uint in_joined = joined.surfaces.behind_cuts(of_side[side], p.position);
        EXPECT_EQ(in_joined, in_more == no_grid ? no_grid : in_more + first);
    }
}

}  // namespace
}  // namespace lw
