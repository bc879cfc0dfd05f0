#include "gather/visibility_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"
#include "gather/renderer.h"
#include "gpu/commands.h"
#include "rooms.h"
#include "scene/gltf.h"

namespace lw {
namespace {

const std::vector<std::string> no_messages;

/// A scene on a device with validation, without photons and rays.
struct Stage {
    explicit Stage(Scene made) : scene(std::move(made)) {}

    Scene scene;
    PhotonMap map{};
    Device device{{"", true}};
    Resident resident{device, scene, map};
};

/// The same pictures with all triangles, and without those that cover no pixel.
struct Views {
    Views(const Stage& stage, vk::Extent2D target)
        : device(stage.device),
          size(target),
          whole(device, stage.resident, size, SIZE_MAX),
          culled(device, stage.resident, size, 0) {}

    Frame frame(const Camera& camera, uint index = 0, uint count = 1) const {
        return make_frame(camera, size, index, count);
    }
    /// Draws the frames one after another without waiting; what the last one sees.
    std::vector<VisibleSample> see(const VisibilityPass& pass, const std::vector<Frame>& frames) const {
        submit_and_wait(device, [&](vk::CommandBuffer commands) {
            for (const Frame& f : frames) pass.record(commands, f);
        });
        return pass.read_samples();
    }

    const Device& device;
    vk::Extent2D size;
    VisibilityPass whole, culled;
};

size_t differing_pixels(const std::vector<VisibleSample>& a, const std::vector<VisibleSample>& b) {
    size_t count = a.size() == b.size() ? 0 : SIZE_MAX / 2;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += std::memcmp(&a[i], &b[i], sizeof(VisibleSample)) != 0;
    return count;
}

size_t seen_pixels(const std::vector<VisibleSample>& samples) {
    size_t count = 0;
    for (const VisibleSample& s : samples) count += s.triangle != no_triangle;
    return count;
}

/// The pictures with culling and without are the same at `jitters` offsets in the pixel, and something is seen.
void expect_same(const Views& views, const Camera& camera, uint jitters = 3) {
    for (uint i = 0; i < jitters; ++i) {
        const std::vector<Frame> frames{views.frame(camera, i, jitters)};
        const std::vector<VisibleSample> whole = views.see(views.whole, frames);
        EXPECT_EQ(differing_pixels(whole, views.see(views.culled, frames)), 0u)
            << camera.name << ' ' << views.size.width << 'x' << views.size.height << " offset " << i;
        EXPECT_GT(seen_pixels(whole), 0u) << camera.name;
    }
}

Camera look(vec3 from, vec3 to, const std::string& name) {
    Camera camera;
    camera.name = name;
    camera.position = from;
    const vec3 back = normalize(from - to);
    const vec3 right = normalize(cross(std::abs(back.y) > 0.99f ? vec3(1, 0, 0) : vec3(0, 1, 0), back));
    camera.rotation = mat3(right, cross(back, right), back);
    return camera;
}

Scene room(size_t triangles, Tessellation tessellation = Tessellation::mixed, Finish finish = Finish::lambert) {
    return make_room({triangles, 2, Lamps::panels, tessellation, finish});
}

Scene loaded(const std::string& name) { return load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name); }

/// Only the first `count` triangles.
Scene first_of(Scene scene, size_t count) {
    scene.triangles.resize(count);
    scene.triangle_objects.resize(count);
    return scene;
}

/// Each triangle twice, one after the other.
Scene doubled(Scene scene) {
    const Scene once = scene;
    scene.triangles.clear();
    scene.triangle_objects.clear();
    for (size_t t = 0; t < once.triangles.size(); ++t)
        for (int copy = 0; copy < 2; ++copy) {
            scene.triangles.push_back(once.triangles[t]);
            scene.triangle_objects.push_back(once.triangle_objects[t]);
        }
    return scene;
}

/// Thin triangles along the rows of pixels of a camera at 0, from close by on the left to far away on the right, or to
/// close by there too.
Scene wires(uint count, bool close_on_both_sides = false) {
    Scene scene = first_of(room(0), 0);
    Rng rng(1, 0, 0);
    const auto number = [&](float low, float high) { return low + (high - low) * rng.next(); };
    for (uint i = 0; i < count; ++i) {
        const float row = number(-0.4f, 0.4f), close = number(0.06f, 0.3f), far = number(10, 1000);
        const vec2 right = close_on_both_sides ? vec2(number(1, 3), close) : vec2(far, far);
        const auto first = uint(scene.positions.size());
        scene.positions.insert(scene.positions.end(), {{number(-3, -0.1f), row * close, -close},
                                                       {right.x, row * right.y, -right.y},
                                                       {right.x, (row + number(0, 0.005f)) * right.y, -right.y}});
        scene.normals.insert(scene.normals.end(), 3, vec3(0, 0, 1));
        scene.triangles.emplace_back(first, first + 1, first + 2);
        scene.triangle_objects.push_back(0);
    }
    return scene;
}

}  // namespace

TEST(Visibility, IsTheSameWithoutTheTrianglesThatCoverNoPixel) {
    for (Scene& scene : std::vector<Scene>{loaded("cornell.gltf"), loaded("apartment.glb"), room(40'000),
                                           room(40'000, Tessellation::uniform)}) {
        const Stage stage(std::move(scene));
        const Views views(stage, {160, 90});
        for (const Camera& camera : stage.scene.cameras) expect_same(views, camera, 2);
        EXPECT_EQ(stage.device.validation_messages(), no_messages);
    }
}

TEST(Visibility, IsTheSameWhereTrianglesAreSmallerThanAPixel) {
    const Stage stage(room(300'000));
    for (const vk::Extent2D size : {vk::Extent2D{96, 96}, {251, 173}})
        expect_same(Views(stage, size), stage.scene.cameras[0], 8);
}

TEST(Visibility, IsTheSameThroughGlass) {
    const Stage stage(room(40'000, Tessellation::mixed, Finish::glass));
    expect_same(Views(stage, {200, 150}), stage.scene.cameras[0], 4);
    EXPECT_GT(CullPass(stage.device, stage.resident).read_draws()[1].instances, 0u);
}

TEST(Visibility, IsTheSameFromInsideOfThingsAndAlongThem) {
    const Stage stage(room(40'000));
    const Views views(stage, {120, 90});
    const vec3 sphere(6.5f, 0.4f, 6.2f);
    expect_same(views, look(sphere, sphere + vec3(1, 0.2f, 0.3f), "inside of a sphere"));
    expect_same(views, look(sphere + vec3(0, 0.4f, 0), sphere + vec3(1, 0.4f, 0.1f), "in its surface"));
    expect_same(views, look({5, 0.001f, 7.9f}, {5, 0, 0}, "along the floor"));
    expect_same(views, look({5, 0.03f, 4}, {5.2f, -0.1f, 4.1f}, "through the floor"));
    Camera telescope = look({0.4f, 1.7f, 7.6f}, sphere, "telescope");
    telescope.yfov = 0.01f;
    expect_same(views, telescope);
    telescope.yfov = 3.0f;
    expect_same(views, telescope);
}

TEST(Visibility, IsTheSameInPicturesOfAFewPixels) {
    const Stage stage(room(20'000));
    for (const vk::Extent2D size : {vk::Extent2D{1, 1}, {1, 7}, {3, 2}})
        expect_same(Views(stage, size), stage.scene.cameras[0], 16);
}

TEST(Visibility, IsTheSameWithAnyNumberOfTriangles) {
    for (const size_t count : {1, 33, 64, 129}) {
        const Stage stage(first_of(room(20'000), count));
        const uvec3 t = stage.scene.triangles[0];
        const std::vector<vec3>& p = stage.scene.positions;
        expect_same(Views(stage, {40, 30}), look({5, 1.5f, 4}, (p[t.x] + p[t.y] + p[t.z]) / 3.0f, "first triangle"));
        EXPECT_EQ(stage.device.validation_messages(), no_messages);
    }
}

TEST(Visibility, IsTheSameWhereLongTrianglesLeaveThePicture) {
    const Stage stage(wires(4000));
    const Views views(stage, {120, 90});
    expect_same(views, look(vec3(0), {0, 0, -1}, "wires"), 8);
    const Stage across(wires(4000, true));
    Camera rolled = look(vec3(0), {0, 0, -1}, "wires from side to side, aslant");
    rolled.rotation = mat3(glm::rotate(glm::mat4(1), 0.5f, vec3(0, 0, 1)));
    for (const float zoom : {1.0f, 1e3f, 1e5f}) {
        rolled.yfov = 1 / zoom;
        expect_same(Views(across, {120, 90}), rolled, 8);
    }
}

TEST(Visibility, OfTwoTrianglesInOnePlaceIsTheFirst) {
    const Stage stage(doubled(room(20'000)));
    const Views views(stage, {160, 120});
    expect_same(views, stage.scene.cameras[0]);
    for (const VisibleSample& s : views.culled.read_samples()) EXPECT_EQ(s.triangle % 2, 0u);
}

TEST(Visibility, OfAFrameDoesNotDependOnTheFramesBefore) {
    const Stage stage(room(40'000, Tessellation::mixed, Finish::glass));
    const Views views(stage, {160, 120});
    const Frame view = views.frame(stage.scene.cameras[0]), other = views.frame(look({5, 1.5f, 4}, {5, 0.5f, 0}, ""));
    const Frame away = views.frame(look({5, 1.5f, -4}, {5, 1.5f, -5}, ""));
    const std::vector<VisibleSample> expected = views.see(views.whole, {view});
    EXPECT_EQ(differing_pixels(views.see(views.culled, {other, away, view}), expected), 0u);
    EXPECT_EQ(seen_pixels(views.see(views.culled, {view, away})), 0u);
    EXPECT_EQ(stage.device.validation_messages(), no_messages);
}

TEST(Visibility, OfAFrameSmallerThanTheTargetIsThatOfItsOwnSize) {
    const Stage stage(room(40'000));
    const Views small(stage, {70, 50}), large(stage, {160, 120});
    const Frame frame = small.frame(stage.scene.cameras[0]);
    const std::vector<VisibleSample> target = large.see(large.culled, {frame});
    std::vector<VisibleSample> corner;
    for (uint y = 0; y < 50; ++y) corner.insert(corner.end(), target.begin() + y * 160, target.begin() + y * 160 + 70);
    EXPECT_EQ(differing_pixels(corner, small.see(small.whole, {frame})), 0u);
}

TEST(Visibility, DrawsFewOfTheTrianglesThatAreSmallerThanAPixel) {
    const Stage stage(room(100'000));
    const CullPass cull(stage.device, stage.resident);
    const uint all = cull.read_draws()[0].instances;
    submit_and_wait(stage.device, [&](vk::CommandBuffer commands) {
        cull.record(commands, make_frame(stage.scene.cameras[0], {100, 100}, 0, 1));
    });
    EXPECT_LT(cull.read_draws()[0].instances, all / 20);
    EXPECT_EQ(stage.device.validation_messages(), no_messages);
}

}  // namespace lw
