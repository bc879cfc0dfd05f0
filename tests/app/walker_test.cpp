// Walking without a window: thousands of random steps end where they may, steps are climbed, walls slide.
#include "app/walk/walker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "scene/gltf.h"

namespace lw {
namespace {

struct Place {
    explicit Place(Scene made)
        : scene(std::move(made)), caster(scene), collision(scene, caster), body(body_for(scene)) {}
    Scene scene;
    RayCaster caster;
    CollisionMesh collision;
    Body body;
};

Place place_of(const std::string& name) { return Place(load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name)); }

void add_quad(Scene& scene, vec3 a, vec3 b, vec3 c, vec3 d) {
    const auto first = uint(scene.positions.size());
    for (const vec3& p : {a, b, c, d}) scene.positions.push_back(p), scene.normals.push_back(vec3(0, 1, 0));
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Scene& scene, vec3 low, vec3 high) {
    const vec3 l = low, h = high;
    add_quad(scene, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
    add_quad(scene, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    add_quad(scene, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
    add_quad(scene, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    add_quad(scene, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
    add_quad(scene, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z});
}

/// A room of 8 x 3 x 8 m around the origin with boxes in it.
Scene room_with(const std::vector<Box>& boxes) {
    Scene scene;
    add_box(scene, {-4, 0, -4}, {4, 3, 4});
    for (const Box& box : boxes) add_box(scene, box.low, box.high);
    scene.triangle_objects.assign(scene.triangles.size(), 0);
    scene.objects = {{0, -1}};
    Material plain{};
    plain.alpha = 1;
    for (TextureSlot* slot : {&plain.base_color_texture, &plain.metallic_roughness_texture, &plain.normal_texture,
                              &plain.emissive_texture, &plain.transmission_texture})
        slot->texture = -1;
    scene.materials = {plain};
    scene.bounds = {vec3(-4, 0, -4), vec3(4, 3, 4)};
    return scene;
}

Walker standing_at(const Place& place, vec3 feet, float yaw = 0) {
    Camera camera;
    camera.position = feet + vec3(0, place.body.eye_height, 0);
    Walker walker = walker_at(camera, place.body, place.collision);
    walker.yaw = yaw;
    return walker;
}

Walker walk_ahead(const Place& place, Walker walker, float seconds) {
    for (float t = 0; t < seconds; t += 0.02f)
        walker = walk(walker, {{0, 0, 1}, {0, 0}, false}, 0.02f, place.body, place.collision);
    return walker;
}

vec3 feet_of(const Walker& walker) { return walker.eye - vec3(0, walker.height, 0); }

/// Wanders with sudden turns, long and short frames, running and walking; `check` sees every state.
template <class Check>
void wander(const Place& place, Walker walker, uint64_t seed, int steps, const Check& check) {
    Rng rng(seed, 0, 0);
    float turn = 0, ahead = 1, right = 0;
    for (int i = 0; i < steps; ++i) {
        if (rng.next() < 0.03f) turn = (rng.next() - 0.5f) * 0.5f;
        if (rng.next() < 0.02f) ahead = rng.next() * 2 - 1, right = rng.next() * 2 - 1;
        if (rng.next() < 0.03f) ahead = 1, right = 0, turn = 0;
        const float seconds = rng.next() < 0.02f ? 0.5f : 0.005f + 0.06f * rng.next();
        walker = walk(walker, {{right, 0, ahead}, {turn, 0}, rng.next() < 0.5f}, seconds, place.body, place.collision);
        check(walker, i);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(Walker, NeverLeavesAClosedRoomHoweverItPushesAtTheWalls) {
    for (const char* name : {"cube.gltf", "cornell.gltf"}) {
        const Place place = place_of(name);
        for (uint64_t seed = 1; seed <= 4; ++seed) {
            const Walker start = walker_at(place.scene.cameras[0], place.body, place.collision);
            if (start.flying) continue;  // the camera of the Cornell box stands outside
            wander(place, start, seed, 5000, [&](const Walker& w, int i) {
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_GT(w.eye[axis], place.scene.bounds[0][axis]) << name << " step " << i;
                    ASSERT_LT(w.eye[axis], place.scene.bounds[1][axis]) << name << " step " << i;
                }
            });
        }
    }
}

TEST(Walker, WandersTheApartmentForThousandsOfStepsAndKeepsItsFloorAndCeiling) {
    const Place place = place_of("apartment.glb");
    for (size_t c = 0; c < place.scene.cameras.size(); ++c) {
        const Walker start = walker_at(place.scene.cameras[c], place.body, place.collision);
        ASSERT_FALSE(start.flying) << place.scene.cameras[c].name;
        vec3 low = start.eye, high = start.eye;
        wander(place, start, c + 1, 4000, [&](const Walker& w, int i) {
            ASSERT_TRUE(place.collision.floor_below(w.eye)) << "step " << i;
            ASSERT_TRUE(place.caster.nearest(w.eye, vec3(0, 1, 0))) << "no ceiling at step " << i;
            low = min(low, w.eye), high = max(high, w.eye);
        });
        EXPECT_GT(length(vec2(high.x - low.x, high.z - low.z)), 2)
            << "got nowhere from " << place.scene.cameras[c].name;
    }
}

/// True when no surface lies between two places of the eye, and both are between the outer walls.
testing::AssertionResult stays_inside(const Place& place, vec3 from, vec3 to) {
    const vec3 low = -vec3(place.scene.origin), high = vec3(glm::dvec3(8, 2.7, 0) - place.scene.origin);
    const bool inside =
        to.x > low.x && to.x < high.x && to.z > low.z - 6 && to.z < high.z && to.y > low.y && to.y < high.y;
    if (inside && place.collision.is_free(from, to)) return testing::AssertionSuccess();
    const glm::dvec3 at = place.scene.origin + glm::dvec3(to);
    return testing::AssertionFailure() << (inside ? "passed a surface" : "left the flat") << " at " << at.x << " "
                                       << at.y << " " << at.z;
}

/// Places on the way of someone who wanders from every camera: all rooms that have no door in between.
std::vector<Walker> places_in_all_rooms(const Place& place) {
    std::vector<Walker> places;
    for (size_t c = 0; c < place.scene.cameras.size(); ++c) {
        const Walker start = walker_at(place.scene.cameras[c], place.body, place.collision);
        wander(place, start, 10 + c, 1500, [&](const Walker& w, int i) {
            if (i % 100 == 0) places.push_back(w);
        });
    }
    return places;
}

TEST(Walker, PushingForAWhileAtEveryWallOfTheApartmentPassesNoneOfThem) {
    const Place place = place_of("apartment.glb");
    const std::vector<Walker> starts = places_in_all_rooms(place);
    vec3 low = starts[0].eye, high = low;
    size_t steps = 0;
    for (const Walker& start : starts)
        for (int way = 0; way < 8; ++way) {
            Walker walker = start;
            walker.yaw = (float(way) + 0.05f) * lw_pi / 4;
            for (int i = 0; i < 90; ++i, ++steps) {  // 3 s, running, slower frames now and then
                const Walker before = walker;
                const float sideways = i > 45 ? std::sin(float(i)) : 0.0f;
                walker =
                    walk(walker, {{sideways, 0, 1}, {0, 0}, true}, i % 10 ? 0.033f : 0.2f, place.body, place.collision);
                ASSERT_TRUE(stays_inside(place, before.eye, walker.eye)) << "way " << way << ", step " << i;
                low = min(low, walker.eye), high = max(high, walker.eye);
            }
        }
    EXPECT_GT(steps, 25'000u);
    EXPECT_GT(high.x - low.x, 7) << "all rooms of the flat of 8 by 6 m";
    EXPECT_GT(high.z - low.z, 5);
}

TEST(Walker, WalksTheSameWayEachTime) {
    const Place place = place_of("apartment.glb");
    const Walker start = walker_at(place.scene.cameras[0], place.body, place.collision);
    const auto end = [&] {
        Walker last;
        wander(place, start, 3, 600, [&](const Walker& w, int) { last = w; });
        return last;
    };
    const Walker first = end(), second = end();
    EXPECT_EQ(first.eye, second.eye);
    EXPECT_EQ(first.yaw, second.yaw);
    EXPECT_NE(first.eye, start.eye);
}

TEST(Walker, ClimbsAStepOf35CentimetresAndNotOneOf45) {
    for (float height : {0.34f, 0.45f}) {
        const Place place(room_with({{vec3(-3, 0, -3), vec3(3, height, -1)}}));
        const Walker end = walk_ahead(place, standing_at(place, vec3(0.3f, 0, 1)), 2);
        if (height < 0.4f) {
            EXPECT_NEAR(feet_of(end).y, height, 1e-3f);
            EXPECT_NEAR(end.eye.y, height + place.body.eye_height, 0.02f);
        } else {
            EXPECT_NEAR(feet_of(end).y, 0, 1e-3f);
            EXPECT_GT(feet_of(end).z, -1);  // the round trunk leans a little over the edge
            EXPECT_LT(feet_of(end).z, -1 + place.body.radius + 0.02f);
        }
    }
}

TEST(Walker, ClimbsStairsAndComesDownAgain) {
    std::vector<Box> steps;
    for (int i = 0; i < 6; ++i)
        steps.push_back({vec3(-1, 0, -0.3f * float(i + 1)), vec3(1, 0.18f * float(i + 1), -0.3f * float(i))});
    const Place place(room_with(steps));
    Walker walker = walk_ahead(place, standing_at(place, vec3(0, 0, 1)), 2.2f);
    float highest = 0;
    walker = standing_at(place, vec3(0, 0, 1));
    for (int i = 0; i < 300; ++i) {
        walker = walk(walker, {{0, 0, 1}, {0, 0}, false}, 0.02f, place.body, place.collision);
        highest = std::max(highest, feet_of(walker).y);
    }
    EXPECT_NEAR(highest, 6 * 0.18f, 1e-3f);
    EXPECT_NEAR(feet_of(walker).y, 0, 1e-3f) << "beyond the last step it falls to the floor";
}

TEST(Walker, SlidesAlongAWallInsteadOfSticking) {
    const Place place(room_with({}));
    const float yaw = -0.6f;  // ahead and to the right, into the wall at x = 4
    const Walker start = standing_at(place, vec3(3.6f, 0, 3), yaw);
    const Walker end = walk_ahead(place, start, 2);
    EXPECT_LT(end.eye.z, start.eye.z - 1);
    EXPECT_NEAR(end.eye.x, 4 - place.body.radius, 0.02f);
}

TEST(Walker, DoesNotStepOffAFloorThatEnds) {
    Scene scene = room_with({});
    scene.positions = {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.triangle_objects = {0, 0};
    const Place place(std::move(scene));
    wander(place, standing_at(place, vec3(0)), 7, 5000, [&](const Walker& w, int) {
        ASSERT_LE(std::max(std::abs(w.eye.x), std::abs(w.eye.z)), 4);
        ASSERT_GT(w.eye.y, 1);
    });
}

TEST(Walker, KeepsTheViewOfACameraUntilItMoves) {
    const Place place = place_of("apartment.glb");
    const Camera& camera = place.scene.cameras[0];
    Walker walker = walker_at(camera, place.body, place.collision);
    for (int i = 0; i < 50; ++i) walker = walk(walker, {}, 0.02f, place.body, place.collision);
    const Camera seen = camera_of(walker, camera.yfov, camera.near);
    EXPECT_EQ(seen.position, camera.position);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(length(seen.rotation[axis] - camera.rotation[axis]), 1e-4f);
}

TEST(Walker, FliesThroughWallsAndLandsOnlyWhereThereIsAFloor) {
    const Place place(room_with({}));
    Walker walker = standing_at(place, vec3(0));
    walker.flying = true;
    walker = walk_ahead(place, walker, 6);
    EXPECT_LT(walker.eye.z, -4);
    EXPECT_TRUE(land(walker, place.body, place.collision).flying);
    walker.eye = vec3(1, 2.9f, 1);
    walker = land(walker, place.body, place.collision);
    EXPECT_FALSE(walker.flying);
    for (int i = 0; i < 100; ++i) walker = walk(walker, {}, 0.02f, place.body, place.collision);
    EXPECT_NEAR(walker.eye.y, place.body.eye_height, 0.05f);
}

}  // namespace
}  // namespace lw
