// Which patches refer to which photons.
#include "maps/references.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "benchmark/rooms.h"
#include "maps/places_in_room.h"
#include "photons/shoot.h"

namespace lw {
namespace {

/// A furnished room with patches of one triangle, shared ones, and cut ones.
struct Room {
    ReferenceInput input() const { return {scene, caster, partition, photons.records}; }

    const Scene scene = make_room({10'000, 2});
    const RayCaster caster{scene};
    const Photons photons = shoot_photons(scene, caster, {.photons = 50'000, .direct_in_photons = true});
    const Partition partition = partition_surfaces(scene, caster, {});
    const References references = find_references(input());
};

TEST(References, AreThoseOfEachPhotonByItselfAndFew) {
    const Room room;
    ASSERT_GT(room.partition.patches.cuts.size(), 0u);
    const PatchFinder finder(room.input());
    std::vector<NeighbourReference> found;
    size_t kept = 0;
    for (uint i = 0; i < room.photons.records.size(); ++i) kept += finder.find(i, finder.own_patch(i), found);
    EXPECT_EQ(room.references.photons.size(), kept + found.size());
    EXPECT_GT(room.references.photons.size(), size_t(1.1 * double(room.photons.records.size())));
}

TEST(References, HoldEveryPhotonAndNoneTwiceInAPatch) {
    const Room room;
    std::vector<uint> times(room.photons.records.size(), 0);
    ASSERT_EQ(room.references.starts.size(), room.partition.patches.count + 1);
    for (size_t p = 0; p < room.partition.patches.count; ++p) {
        std::vector<uint> of_map(room.references.photons.begin() + int64_t(room.references.starts[p]),
                                 room.references.photons.begin() + int64_t(room.references.starts[p + 1]));
        std::sort(of_map.begin(), of_map.end());
        EXPECT_EQ(std::adjacent_find(of_map.begin(), of_map.end()), of_map.end()) << p;
        for (uint photon : of_map) ++times[photon];
    }
    EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](uint count) { return count > 0; }));
}

TEST(References, AreWithinTheRadiusOfTheirPatch) {
    const Room room;
    for (size_t p = 0; p < room.partition.patches.count; ++p)
        for (uint64_t i = room.references.starts[p]; i < room.references.starts[p + 1]; ++i) {
            const PatchShape& shape = room.partition.shapes[p];
            const vec3 local = shape.to_local(room.photons.records[room.references.photons[i]].position);
            const vec3 outside = max(max(shape.low - local, local - shape.high), vec3(0));
            EXPECT_LE(length(outside), 1.0001f * room.partition.radii[p]) << p;
        }
}

TEST(References, AreThoseOfEveryPatchAndPhotonByTheRule) {
    const test::RoomPatches& room = test::furnished_room();
    const RayCaster caster(room.scene);
    const std::vector<Photon> photons = test::places_in(room, 5'000);
    const References found = find_references({room.scene, caster, room.partition, photons});
    size_t present = 0, absent = 0;
    for (uint patch = 0; patch < room.partition.patches.count; ++patch) {
        const std::vector<uint> held(found.photons.begin() + int64_t(found.starts[patch]),
                                     found.photons.begin() + int64_t(found.starts[patch + 1]));
        for (uint i = 0; i < photons.size(); ++i) {
            const bool is_held = std::find(held.begin(), held.end(), i) != held.end();
            const uint own =
                room.partition.patches.at(2 * photons[i].triangle + photons[i].side(), photons[i].position);
            const auto belonging = test::belonging_of(room, photons[i], patch);
            const bool may_be_hidden =
                dot(room.partition.shapes[own].normal, room.partition.shapes[patch].normal) > 0.99f;  // by a wall
            if (own == patch) {
                EXPECT_TRUE(is_held || !room.partition.shapes[own].outline.empty()) << patch << " " << i;
            } else if (belonging == test::Belonging::no) {
                EXPECT_FALSE(is_held) << patch << " " << i;
                ++absent;
            } else if (belonging == test::Belonging::sure && !may_be_hidden) {
                EXPECT_TRUE(is_held) << patch << " " << i;
                ++present;
            }
        }
    }
    EXPECT_GT(present, 1000u);
    EXPECT_GT(absent, 100'000u);
}

}  // namespace
}  // namespace lw
