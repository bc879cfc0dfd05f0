// The map file: round trip, and refusal of every kind of damage.
#include "file/map_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/random.h"
#include "file/map_checks.h"
#include "maps/bake.h"
#include "robustness/room.h"
#include "scene/gltf.h"

namespace lw {
namespace {

class MapFile : public testing::Test {
  protected:
    MapFile()
        : scene(load_gltf(LUMENWALK_SOURCE_DIR "/data/cube.gltf")),
          path(std::filesystem::temp_directory_path() / ("lw_map_" + std::to_string(getpid()) + ".pmap")) {
        const RayCaster caster(scene);
        map = bake(scene, caster, {.photons = 500});
        save_photon_map(path, map);
        std::ifstream in(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    ~MapFile() override { std::filesystem::remove(path); }
    void write(const std::string& content) {
        std::ofstream(path, std::ios::binary).write(content.data(), std::streamsize(content.size()));
    }

    Scene scene;
    std::filesystem::path path;
    PhotonMap map;
    std::string bytes;
};

TEST_F(MapFile, RoundTrips) {
    const PhotonMap got = load_photon_map(path, scene);
    EXPECT_EQ(got.stored_photons, map.stored_photons);
    EXPECT_EQ(got.settings.radius, map.settings.radius);
    ASSERT_EQ(got.places.size(), map.places.size());
    EXPECT_EQ(std::memcmp(got.places.data(), map.places.data(), map.places.size() * sizeof(PhotonPlace)), 0);
    EXPECT_EQ(got.fluxes, map.fluxes);
    EXPECT_EQ(got.grid_of_side, map.grid_of_side);
    const size_t records = map.coverage.size() * scene.lights.size();
    for (size_t i = 0; i < records; ++i) ASSERT_EQ(got.irradiance[i], map.irradiance[i]);
}

TEST_F(MapFile, CutAtEveryLengthIsRefused) {
    for (size_t length = 0; length < bytes.size(); ++length) {
        write(bytes.substr(0, length));
        EXPECT_THROW(load_photon_map(path, scene), Error) << length;
    }
}

TEST_F(MapFile, FlippedBytesAreRefused) {
    Rng rng(1, 1, 1);
    for (int i = 0; i < 2000; ++i) {
        std::string damaged = bytes;
        damaged[size_t(rng.next() * float(bytes.size() - 1))] ^= char(1 << int(rng.next() * 7.99f));
        write(damaged);
        EXPECT_THROW(load_photon_map(path, scene), Error);
    }
}

TEST_F(MapFile, OfAnotherSceneIsRefusedAndSaysWhichChanged) {
    scene.content_hash ^= 1;
    try {
        load_photon_map(path, scene);
        FAIL() << "accepted";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("scene cube.gltf has changed"), std::string::npos) << e.what();
    }
}

TEST_F(MapFile, DamagedMapSaysThatTheMapChanged) {
    bytes.back() = char(bytes.back() ^ 1);
    write(bytes);
    try {
        load_photon_map(path, scene);
        FAIL() << "accepted";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("the map file has changed"), std::string::npos) << e.what();
    }
}

TEST_F(MapFile, IntoAMissingFolderIsRefusedAndLeavesNothing) {
    EXPECT_THROW(save_photon_map("/nonexistent/folder/x.pmap", map), Error);
    EXPECT_FALSE(std::filesystem::exists("/nonexistent/folder"));
}

/// Damage with a right checksum: only the bounds are left to refuse what would lead the shaders out of their arrays.
TEST_F(MapFile, SignedMapsThatLeadOutOfTheirArraysAreRefused) {
    int cases = 0;
    const auto refused = [&](const auto& damage) {
        PhotonMap bad = map;
        damage(bad);
        save_photon_map(path, bad);
        ++cases;
        EXPECT_THROW(load_photon_map(path, scene), Error) << "case " << cases;
    };
    ASSERT_FALSE(map.visible_lamps.empty());
    refused([](PhotonMap& m) { m.coverage.pop_back(); });
    refused([](PhotonMap& m) { m.coverage.clear(); });
    refused([](PhotonMap& m) { m.coverage.clear(), m.visible_lamps.clear(); });
    refused([](PhotonMap& m) { m.coverage.clear(), m.visible_lamps.clear(), m.irradiance = {}; });
    refused([](PhotonMap& m) { m.visible_lamps.pop_back(); });
    refused([](PhotonMap& m) { m.irradiance.values.pop_back(); });
    refused([](PhotonMap& m) { m.irradiance.marks.pop_back(); });
    refused([](PhotonMap& m) { m.irradiance.marks.push_back(0); });
    refused([](PhotonMap& m) { m.caustic_sides = SparseArray(std::vector<uint>(m.grid_of_side.size(), 0)); });
    refused([](PhotonMap& m) { m.shadow_masks.push_back({uint(m.coverage.size()), 0, 1, 0, 0}); });
    refused([](PhotonMap& m) { m.shadow_masks.push_back({0, uint(m.emitted.size()), 1, 0, 0}); });
    refused([](PhotonMap& m) { m.shadow_masks.assign(2, {0, 0, 1, 0, 0}); });
    refused([](PhotonMap& m) { m.irradiance = {}; });
    refused([](PhotonMap& m) { m.places.pop_back(); });
    refused([](PhotonMap& m) { m.places[0].h_light_and_path |= light_mask << 16; });
    refused([](PhotonMap& m) { m.grid_of_side[0] = uint(m.grids.size()); });
    refused([](PhotonMap& m) { m.cell_starts[0] = uint(m.places.size()) + 1; });
    refused([](PhotonMap& m) { m.cell_starts[0] = 1, m.cell_starts[1] = std::max(m.cell_starts[1], 1u); });
    refused([](PhotonMap& m) { m.irradiance_scale = 0; });
    refused([](PhotonMap& m) { m.flux_scale = -1; });
    refused([](PhotonMap& m) { m.caustic_grids = 1; });
    refused([](PhotonMap& m) { m.caustic_grids = uint(m.grids.size()) + 1; });
}

TEST_F(MapFile, WithCausticsRoundTripsAndIsRefusedWhenTheirGridsAreMixedUp) {
    const Scene glass = load_gltf(LUMENWALK_SOURCE_DIR "/data/glass_sphere.gltf");
    const RayCaster caster(glass);
    const PhotonMap good = bake(glass, caster, {.photons = 5000});
    ASSERT_GT(good.caustic_grids, 0u);
    save_photon_map(path, good);
    const PhotonMap got = load_photon_map(path, glass);
    EXPECT_EQ(got.caustic_grids, good.caustic_grids);
    EXPECT_EQ(got.grid_of_side, good.grid_of_side);
    for (size_t side = 0; side < good.grid_of_side.size(); ++side)
        ASSERT_EQ(got.caustic_grid_of(side), good.caustic_grid_of(side));
    const auto refused = [&](const auto& damage) {
        PhotonMap bad = good;
        damage(bad);
        save_photon_map(path, bad);
        EXPECT_THROW(load_photon_map(path, glass), Error);
    };
    EXPECT_EQ(got.smooth_caustics, good.smooth_caustics);
    ASSERT_FALSE(good.smooth_caustics.empty());
    refused([](PhotonMap& m) { m.smooth_caustics.pop_back(); });
    refused([](PhotonMap& m) { --m.caustic_grids; });
    refused([](PhotonMap& m) { m.grid_of_side[0] = uint(m.grids.size()) - 1; });
    refused([](PhotonMap& m) { m.caustic_sides.values.back() = 1; });
    refused([](PhotonMap& m) { m.caustic_sides.values.back() = uint(m.grids.size() + m.cuts.size()) + 1; });
    refused([](PhotonMap& m) { m.caustic_sides = {}; });
}

TEST_F(MapFile, SignedGridsThatLeadOutOfTheirArraysAreRefused) {
    const auto refused = [&](const char* what, const auto& damage) {
        PhotonMap bad = map;
        damage(bad.grids.back());
        save_photon_map(path, bad);
        EXPECT_THROW(load_photon_map(path, scene), Error) << what;
    };
    refused("columns", [](SurfaceGrid& g) { ++g.columns; });
    refused("no rows", [](SurfaceGrid& g) { g.rows = 0; });
    refused("first cell", [](SurfaceGrid& g) { ++g.first_cell; });
    refused("lattice columns", [](SurfaceGrid& g) { ++g.lattice.columns; });
    refused("huge lattice", [](SurfaceGrid& g) { g.lattice.columns = g.lattice.rows = 0xffffffffu; });
    refused("no cell of a lattice", [](SurfaceGrid& g) { g.lattice.rows = 1; });
    refused("first node", [](SurfaceGrid& g) { ++g.lattice.first_node; });
    refused("step", [](SurfaceGrid& g) { g.lattice.step.x = 0; });
    refused("place", [](SurfaceGrid& g) { g.lattice.low.y = NAN; });
    refused("origin", [](SurfaceGrid& g) { g.origin.x = 1e30f; });
    refused("axis", [](SurfaceGrid& g) { g.u_axis.x = 1e30f; });
    refused("cell size", [](SurfaceGrid& g) { g.cell_size = 1e-30f; });
    refused("radius", [](SurfaceGrid& g) { g.radius = INFINITY; });
}

/// A map cut along a wall: what the cuts lead to is checked, so that no way through them leads out or round.
TEST_F(MapFile, WithCutsRoundTripsAndIsRefusedWhenTheyLeadAstray) {
    test::Room room = test::plain_room();
    room.walls = test::joined(room.walls, test::quad({2, 0, 0}, {0, 0, 5}, {0, 3, 0}));
    const test::Baked baked(room, 5000);
    ASSERT_FALSE(baked.map.cuts.empty()) << "no map is cut";
    save_photon_map(path, baked.map);
    const PhotonMap got = load_photon_map(path, baked.scene);
    EXPECT_EQ(got.grids.size(), baked.map.grids.size());
    EXPECT_EQ(got.grid_of_side, baked.map.grid_of_side);
    ASSERT_EQ(got.cuts.size(), baked.map.cuts.size());
    EXPECT_EQ(std::memcmp(got.cuts.data(), baked.map.cuts.data(), got.cuts.size() * sizeof(Cut)), 0);
    const auto refused = [&](const char* what, const auto& damage) {
        PhotonMap bad = baked.map;
        damage(bad);
        save_photon_map(path, bad);
        EXPECT_THROW(load_photon_map(path, baked.scene), Error) << what;
    };
    refused("to itself", [&](PhotonMap& m) { m.cuts[0].front = cut_bit; });
    refused("beyond the cuts", [&](PhotonMap& m) { m.cuts[0].back = uint(m.cuts.size()) | cut_bit; });
    refused("no number", [&](PhotonMap& m) { m.cuts[0].point.x = NAN; });
    refused("no direction", [&](PhotonMap& m) { m.cuts[0].normal.y = 1e30f; });
    refused("too many one after the other", [&](PhotonMap& m) {
        const Cut next{m.cuts[0].point, no_grid, m.cuts[0].normal, no_grid};
        for (uint i = 0; i <= max_cuts_deep + 1; ++i) {
            if (i > 0) m.cuts.back().front = uint(m.cuts.size()) | cut_bit;
            m.cuts.push_back(next);
        }
        m.cuts.back().front = 0;
    });
}

/// What a map in memory cannot be, but a file can.
TEST_F(MapFile, CutsThatOnlyAFileCanHaveAreRefused) {
    test::Room room = test::plain_room();
    room.walls = test::joined(room.walls, test::quad({2, 0, 0}, {0, 0, 5}, {0, 3, 0}));
    const test::Baked baked(room, 5000);
    const GridRecords good = records_of(baked.map);
    EXPECT_NO_THROW(check_records(path, good, baked.map, baked.scene));
    const auto first =
        std::find_if(good.records.begin(), good.records.end(), [](const SurfaceGrid& g) { return is_cut(g); });
    ASSERT_NE(first, good.records.end()) << "no map is cut";
    const auto cut = size_t(first - good.records.begin());
    const auto refused = [&](const char* what, const auto& damage) {
        GridRecords bad = good;
        damage(bad);
        EXPECT_THROW(check_records(path, bad, baked.map, baked.scene), Error) << what;
    };
    refused("before a map", [&](GridRecords& file) {
        std::swap(file.records[cut - 1], file.records[cut]);
        const auto renumber = [&](uint& index) {
            if (index == cut || index == cut - 1) index = uint(2 * cut - 1) - index;
        };
        for (uint& index : file.of_side) renumber(index);
        for (SurfaceGrid& g : file.records)
            if (is_cut(g)) renumber(g.rows), renumber(g.first_cell);
    });
    refused("to itself", [&](GridRecords& file) { file.records[cut].rows = uint(cut); });
    refused("beyond the grids", [&](GridRecords& file) { file.records[cut].first_cell = uint(file.records.size()); });
    refused("with a lattice", [&](GridRecords& file) { file.records[cut].lattice.columns = 3; });
}

/// Each of these was found by taking its check away: no quick test failed.
TEST_F(MapFile, WhatOnlyOneCheckRefusesIsNamed) {
    const auto told = [&] {
        try {
            load_photon_map(path, scene);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    const auto refused = [&](const char* named, const auto& damage) {
        PhotonMap bad = map;
        damage(bad);
        save_photon_map(path, bad);
        EXPECT_NE(told().find(named), std::string::npos) << named << ": " << told();
    };
    refused("lattices and coverage do not agree", [](PhotonMap& m) { m.coverage.push_back(0); });
    refused("cells and grids do not agree", [](PhotonMap& m) { m.cell_starts.push_back(m.cell_starts.back()); });
    refused("cells and references do not agree", [](PhotonMap& m) {
        m.places.push_back(m.places.back());
        m.fluxes.push_back(0);
    });
    refused("it has no cells", [](PhotonMap& m) { m.cell_starts.clear(); });
    refused("the number of lamps", [](PhotonMap& m) { m.emitted.push_back(1); });
    refused("more grids of caustics than grids", [](PhotonMap& m) { m.caustic_grids = uint(m.grids.size()) + 1; });
    refused("the number of triangles", [](PhotonMap& m) { m.grid_of_side.push_back(no_grid); });
    refused("the record arrays differ", [](PhotonMap& m) { m.fluxes.pop_back(); });
    refused("its settings are not valid", [](PhotonMap& m) { m.settings.neighbour_angle_deg = 120; });
    const auto changed = [&](const char* named, size_t at, char byte) {
        std::string damaged = bytes;
        damaged[at] = byte;
        write(damaged);
        EXPECT_NE(told().find(named), std::string::npos) << named << ": " << told();
    };
    changed("not a Lumenwalk photon map", 0, 'X');
    changed("written by another version", 8, 9);
    changed("cut short or its section sizes are wrong", 87, 1);
    write(bytes + "more");
    EXPECT_NE(told().find("bytes after its last section"), std::string::npos) << told();
    std::filesystem::remove(path);
    EXPECT_NE(told().find("no photon map here"), std::string::npos) << told();
}

TEST_F(MapFile, LambertSceneStoresNoDirections) { EXPECT_FALSE(map.has_directions()); }

}  // namespace
}  // namespace lw
