// Pictures in motion: what the same place of a surface shows from frame to frame while the camera walks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/room.h"
#include "measure/probe.h"
#include "programs/lavapipe.h"
#include "scene/camera.h"

namespace lw {
namespace {

constexpr int width = 240, height = 160;

/// Illuminance of a frame, and how to look it up from the next one.
struct Seen {
    Camera camera;
    std::vector<float> lux;
};

std::optional<vec2> pixel_of(const Camera& camera, vec3 point) {
    const vec3 view = transpose(camera.rotation) * (point - camera.position);
    if (view.z > -camera.near) return std::nullopt;
    const float scale = 0.5f * float(height) / std::tan(0.5f * camera.yfov);
    return vec2(0.5f * float(width) - view.x / view.z * scale, 0.5f * float(height) + view.y / view.z * scale);
}

/// Illuminance between the four pixels around a place, if they all show the plane of `hit`.
std::optional<float> lux_around(const Room& room, const Seen& seen, vec2 place, const Hit& hit) {
    const vec2 corner = floor(place - vec2(0.5f)), part = place - vec2(0.5f) - corner;
    if (corner.x < 0 || corner.y < 0 || corner.x + 1 >= width || corner.y + 1 >= height) return std::nullopt;
    const SurfaceReader surfaces(room.world.scene);
    const Surface wanted = surfaces.surface_at(hit.triangle, hit.barycentrics);
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
        const int x = int(corner.x) + i % 2, y = int(corner.y) + i / 2;
        const vec3 direction = camera_direction(seen.camera, float(x) + 0.5f, float(y) + 0.5f, width, height);
        const auto there = seen_from(room.world.scene, room.world.caster, seen.camera.position, direction);
        if (!there) return std::nullopt;
        const Surface s = surfaces.surface_at(there->triangle, there->barycentrics);
        if (dot(s.geometric_normal, wanted.geometric_normal) < 0.9999f ||
            std::abs(dot(s.position - wanted.position, wanted.geometric_normal)) > 1e-3f)
            return std::nullopt;
        const float weight = (i % 2 ? part.x : 1 - part.x) * (i / 2 ? part.y : 1 - part.y);
        sum += weight * seen.lux[size_t(y * width + x)];
    }
    return sum;
}

/// Relative differences of the same surface points in two frames, sorted.
std::vector<float> changes(const Room& room, const Seen& before, const Seen& after) {
    std::vector<float> result;
    for (int y = 2; y < height; y += 4)
        for (int x = 2; x < width; x += 4) {
            const vec3 direction = camera_direction(after.camera, float(x) + 0.5f, float(y) + 0.5f, width, height);
            const auto hit = seen_from(room.world.scene, room.world.caster, after.camera.position, direction);
            if (!hit) continue;
            const vec3 point = SurfaceReader(room.world.scene).surface_at(hit->triangle, hit->barycentrics).position;
            const auto place = pixel_of(before.camera, point);
            const auto lux = place ? lux_around(room, before, *place, *hit) : std::nullopt;
            const float now = after.lux[size_t(y * width + x)];
            if (lux && std::max(*lux, now) > 1) result.push_back(std::abs(now - *lux) / std::max(*lux, now));
        }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(Motion, ThePlacesOfSurfacesKeepTheirLightWhileTheCameraWalks) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room("cornell.gltf", {width, height}, 100'000);
    const auto frame_at = [&](float t) {
        Seen seen{room.request.camera, {}};
        seen.camera.position += vec3(0.3f * t, 0.05f * t, -0.8f * t);
        room.request.camera = seen.camera;
        room.frame({{}, 5});
        seen.lux = room.renderer.read_values().find("illuminance")->values;
        return seen;
    };
    std::vector<float> all;
    Seen before = frame_at(0);
    for (int i = 1; i <= 6; ++i) {
        const Camera start = room.request.camera;
        const Seen after = frame_at(0.04f);  // 3.4 cm: a brisk walk at 40 frames a second
        ASSERT_NE(start.position, after.camera.position);
        const std::vector<float> some = changes(room, before, after);
        all.insert(all.end(), some.begin(), some.end());
        before = after;
    }
    std::sort(all.begin(), all.end());
    ASSERT_GT(all.size(), 4000u);
    RecordProperty("median", std::to_string(all[all.size() / 2]));
    EXPECT_LT(all[all.size() / 2], 0.002f);
    EXPECT_LT(all[all.size() * 9 / 10], 0.015f);
    EXPECT_LT(all[all.size() * 98 / 100], 0.05f);
    std::printf("changes from frame to frame: median %.4f, 90 %% %.4f, 98 %% %.4f of %zu\n",
                double(all[all.size() / 2]), double(all[all.size() * 9 / 10]), double(all[all.size() * 98 / 100]),
                all.size());
}

TEST(Motion, AFrameOfTheSameViewIsTheSameFrameWhateverWasShownBefore) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    const Camera here = room.request.camera;
    const std::vector<uint32_t> first = room.frame({{}, 5});
    room.request.camera.position += vec3(0.1f, 0, -0.3f);
    room.frame({{}, 5});
    room.frame({{}, 5});
    room.request.camera = here;
    EXPECT_EQ(room.frame({{}, 5}), first);
}

}  // namespace
}  // namespace lw
