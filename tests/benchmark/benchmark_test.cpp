// The parts of the benchmark that could lie unnoticed: its rooms, its neighbour searches, its fits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "benchmark/document.h"
#include "benchmark/neighbour_search.h"
#include "benchmark/rooms.h"
#include "benchmark/table.h"
#include "benchmark/timing.h"
#include "maps/build.h"
#include "photons/shoot.h"
#include "programs/command.h"

namespace lw {
namespace {

TEST(Rooms, HaveAboutTheTrianglesAskedForAndTheLamps) {
    for (Tessellation kind : {Tessellation::uniform, Tessellation::mixed})
        for (size_t wanted : {1'000u, 100'000u}) {
            RoomSettings settings;
            settings.triangles = wanted;
            settings.tessellation = kind;
            settings.lights = 5;
            const Scene room = make_room(settings);
            EXPECT_NEAR(double(room.triangles.size()) / double(wanted), 1, 0.25) << name_of(kind) << " " << wanted;
            EXPECT_EQ(room.lights.size(), 5u);
        }
}

TEST(Rooms, LetNoLightEscape) {
    const Scene room = make_room({});
    const RayCaster caster(room);
    const Photons photons = shoot_photons(room, caster, {.photons = 20'000, .direct_in_photons = true});
    for (const LightBalance& light : photons.lights) EXPECT_LT(light.escaped, 1e-3 * light.flux_out);
}

/// Distances to the nearest photons, ascending, m.
template <class Structure>
std::vector<float> distances(const Structure& structure, const Query& query, uint k, float radius) {
    NearestPhotons nearest;
    nearest.start(k, radius * radius);
    structure.find(query, nearest);
    std::vector<float> found;
    for (const auto& entry : nearest.entries()) found.push_back(std::sqrt(entry.distance_squared));
    std::sort(found.begin(), found.end());
    return found;
}

TEST(NeighbourSearch, FourStructuresFindTheSamePhotonsOnAFlatFloor) {
    RoomSettings settings;
    settings.triangles = 100;
    const Scene room = make_room(settings);
    const RayCaster caster(room);
    BakeSettings bake;
    bake.photons = 200'000;
    const Photons photons = shoot_photons(room, caster, {.photons = bake.photons, .direct_in_photons = true});
    const PhotonMap map = build_photon_map(room, caster, photons, bake);
    const PhotonCloud cloud(room, photons.records);
    const GridSearch grid(map);
    const GridTreeSearch trees(map);
    const GlobalTreeSearch tree(cloud, map);
    const HashGridSearch hash(cloud, map, 0.1f);
    for (const vec2 place : {vec2(3.1f, 1.3f), vec2(7, 6), vec2(0.05f, 4), vec2(5, 7.98f)}) {
        const vec3 point(place.x, 0, place.y);
        const std::optional<Hit> floor = caster.nearest(point + vec3(0, 0.1f, 0), vec3(0, -1, 0));
        ASSERT_TRUE(floor);
        const Query query{point, vec3(0, 1, 0), map.behind_cuts(map.grid_of_side[2 * floor->triangle], point)};
        ASSERT_NE(query.grid, no_grid);
        const float radius = map.grids[query.grid].radius;
        const std::vector<float> expected = distances(grid, query, 50, radius);
        ASSERT_EQ(expected.size(), 50u);
        for (const auto& other : {distances(trees, query, 50, radius), distances(tree, query, 50, radius),
                                  distances(hash, query, 50, radius)}) {
            ASSERT_EQ(other.size(), expected.size());
            for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(other[i], expected[i], 1e-3f);
        }
    }
}

TEST(Timing, FitsTheExponentOfAPowerLaw) {
    EXPECT_NEAR(fitted_exponent({1, 2, 4, 8}, {3, 12, 48, 192}), 2, 1e-12);
    EXPECT_TRUE(std::isnan(fitted_exponent({1, 1}, {3, 4})));
}

TEST(Table, LeavesACellEmptyWhereARowHasNoSuchColumn) {
    const Table table{"s", "n", "caption", {{{"a", 1}}, {{"b", 0.25}}}};
    EXPECT_EQ(to_markdown(table), "caption\n\n| a | b |\n|---|---|\n| 1 |  |\n|  | 0.25 |\n");
}

TEST(Document, TakesASectionBetweenItsLinesAndKeepsTheRest) {
    const TempFolder folder;
    const std::filesystem::path path = folder.path() / "page.md";
    std::ofstream(path) << "head\n<!-- benchmark a -->\nold\n<!-- end of benchmark -->\nmiddle\n<!-- benchmark b -->\n"
                           "<!-- end of benchmark -->\nfoot\n";
    check_places(path, {"a", "b"});
    replace_section(path, "b", "new b\n");
    replace_section(path, "a", "new a\n");
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_EQ(text.str(),
              "head\n<!-- benchmark a -->\nnew a\n<!-- end of benchmark -->\nmiddle\n<!-- benchmark b -->\nnew b\n"
              "<!-- end of benchmark -->\nfoot\n");
    EXPECT_THROW(check_places(path, {"a", "c"}), Error);
    std::ofstream(path) << "<!-- benchmark a -->\ntext\n<!-- benchmark b -->\n<!-- end of benchmark -->\n";
    EXPECT_THROW(check_places(path, {"a"}), Error) << "the end is that of b";
    EXPECT_THROW(check_places(folder.path() / "none.md", {"a"}), Error);
}

}  // namespace
}  // namespace lw
