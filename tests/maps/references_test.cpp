// Which maps refer to which photons.
#include "maps/references.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "benchmark/rooms.h"
#include "maps/build.h"
#include "maps/cuts.h"
#include "photons/shoot.h"

namespace lw {
namespace {

/// A furnished room with patches of one triangle, shared ones, and cut ones.
struct Room {
    Room()
        : scene(make_room({10'000, 2})),
          caster(scene),
          photons(shoot_photons(scene, caster, {.photons = 50'000, .direct_in_photons = true})) {
        cut_patches(scene, radius, patches, shapes);
        radii = patch_radii(shapes, radius, 0.5f * radius);
        neighbours.emplace(shapes, radii, 60.0f, radius);
        references = find_references(input());
    }
    ReferenceInput input() const { return {scene, photons.records, patches, shapes, radii, 60, *neighbours, caster}; }

    const Scene scene;
    const RayCaster caster;
    const Photons photons;
    const float radius = automatic_radius(scene, 50'000);
    Patches patches = group_triangles(scene, 6 * radius);
    std::vector<PatchShape> shapes = shapes_of(scene, patches);
    std::vector<float> radii;
    std::optional<Neighbours> neighbours;
    References references;
};

TEST(References, AreAsManyAsThoseOfEachPhotonByItself) {
    const Room room;
    ASSERT_GT(room.patches.cuts.size(), 0u);
    const double each = sample_references(room.input(), room.photons.records.size());
    EXPECT_GT(each, 1.1);
    EXPECT_DOUBLE_EQ(double(room.references.photons.size()) / double(room.photons.records.size()), each);
}

TEST(References, HoldEveryPhotonAndNoneTwiceInAMap) {
    const Room room;
    std::vector<uint> times(room.photons.records.size(), 0);
    ASSERT_EQ(room.references.starts.size(), room.patches.count + 1);
    for (size_t p = 0; p < room.patches.count; ++p) {
        std::vector<uint> of_map(room.references.photons.begin() + int64_t(room.references.starts[p]),
                                 room.references.photons.begin() + int64_t(room.references.starts[p + 1]));
        std::sort(of_map.begin(), of_map.end());
        EXPECT_EQ(std::adjacent_find(of_map.begin(), of_map.end()), of_map.end()) << p;
        for (uint photon : of_map) ++times[photon];
    }
    EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](uint count) { return count > 0; }));
}

TEST(References, AreWithinTheRadiusOfTheirMap) {
    const Room room;
    for (size_t p = 0; p < room.patches.count; ++p)
        for (uint64_t i = room.references.starts[p]; i < room.references.starts[p + 1]; ++i) {
            const PatchShape& shape = room.shapes[p];
            const vec3 local = shape.to_local(room.photons.records[room.references.photons[i]].position);
            const vec3 outside = max(max(shape.low - local, local - shape.high), vec3(0));
            EXPECT_LE(length(outside), 1.0001f * room.radii[p]) << p;
        }
}

}  // namespace
}  // namespace lw
