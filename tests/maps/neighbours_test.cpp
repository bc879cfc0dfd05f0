// The candidates of a cell of a patch: never fewer than the patches to which a photon there belongs.
#include "maps/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/lab_scene.h"
#include "maps/places_in_room.h"

namespace lw {
namespace {

using namespace test;

TEST(Neighbours, HoldEveryPatchThatAPhotonBelongsTo) {
    const RoomPatches& room = furnished_room();
    const Neighbours& neighbours = room.partition.neighbours;
    size_t belonging = 0, candidates = 0, photons = 0;
    for (const Photon& photon : places_in(room, 4'000)) {
        const uint own = room.partition.patches.at(2 * photon.triangle + photon.side(), photon.position);
        const auto near = neighbours.near(own, photon.position);
        ++photons, candidates += near.size();
        for (uint patch = 0; patch < room.partition.patches.count; ++patch) {
            if (patch == own || belonging_of(room, photon, patch) != Belonging::sure) continue;
            ++belonging;
            EXPECT_NE(std::find(near.begin(), near.end(), patch), near.end()) << own << " " << patch;
            const auto all = neighbours.of(own);
            EXPECT_NE(std::find(all.begin(), all.end(), patch), all.end()) << own << " " << patch;
        }
    }
    EXPECT_GT(belonging, 1000u);
    EXPECT_LT(candidates, photons * room.partition.patches.count / 10);  // few of all patches
}

TEST(Neighbours, AreNoneInTheMiddleOfAWall) {
    LabScene lab;
    lab.add_room(vec3(0), vec3(10, 3, 8), 0.5f);
    const Scene scene = lab.finish();
    constexpr float radius = 0.25f;
    const Patches patches = group_triangles(scene, 6 * radius);
    const Neighbours neighbours(shapes_of(scene, patches), std::vector<float>(patches.count, radius), 60,
                                std::vector<float>(patches.count, radius));
    size_t middle = 0;
    for (int i = 1; i < 40; ++i)
        for (int k = 1; k < 32; ++k) {
            const vec3 p(0.25f * float(i), 0,
                         0.25f * float(k));  // of the floor, whose first triangle is above z = 0.8 x
            const float to_edges = std::min({p.x, 8 - p.z, (p.z - 0.8f * p.x) / std::sqrt(1 + 0.8f * 0.8f)});
            if (to_edges < 3 * radius) continue;  // the radius, and the diagonal of a cell
            EXPECT_TRUE(neighbours.near(patches.at(0, p), p).empty()) << p.x << " " << p.z;
            ++middle;
        }
    EXPECT_GT(middle, 100u);
}

}  // namespace
}  // namespace lw
