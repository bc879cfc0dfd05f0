// Pictures of the room written down in hard ways, by the shaders: mean within 1 %, RMSE within twice the noise of two
// seeds; any camera. Prints rows of the table in docs/robustness.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gather/renderer.h"
#include "programs/lavapipe.h"
#include "robustness/disguises.h"
#include "trace/build_bvh.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};

double mean_of(const std::vector<float>& values) {
    double sum = 0;
    for (float v : values) sum += double(v);
    return sum / double(values.size());
}

Image picture_of(const Device& device, const Baked& baked, const Camera& camera) {
    const Bvh bvh = build_bvh(baked.scene);
    const Resident resident(device, baked.scene, baked.map, bvh);
    Renderer renderer(device, resident, 32, 24);
    RenderSettings settings;
    settings.exposure_ev = 0.0f;
    Camera near_camera = camera;
    near_camera.near = 1e-3f * baked.scene.size();  // metres in the file, also of a camera under a scaled node
    return renderer.render(near_camera, settings).image;
}

/// Illuminances of the room's picture, as of the plain room: over the scale, and that of a mirrored one turned over.
std::vector<float> illuminances_of(const Device& device, const Baked& baked, const Disguise& disguise) {
    const Image image = picture_of(device, baked, baked.scene.cameras[0]);
    std::vector<float> lux = image.find("illuminance")->values;
    for (float& e : lux) EXPECT_TRUE(std::isfinite(e) && e >= 0) << disguise.name;
    for (float& e : lux) e /= float(disguise.scale);
    if (std::string(disguise.name) == "mirrored")
        for (auto row = lux.begin(); row != lux.end(); row += image.width) std::reverse(row, row + image.width);
    return lux;
}

double rmse_of(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i) squares += std::pow(double(a[i]) - double(b[i]), 2);
    return std::sqrt(squares / double(a.size())) / mean_of(a);
}

/// Of those that change what the shaders compute with: places, sizes, sides, triangles that hardly have any. Each takes
/// seconds of making pipelines; that shaders and CPU estimate the same is the business of other tests.
constexpr const char* drawn[] = {"_away",   "wide_by", "mirrored", "inside_out",
                                 "mixed_w", "million", "needles",  "of_denormal"};

TEST(RobustnessOnADevice, TheRoomHasTheSamePicture) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Disguise none{"none", plain_room};
    const std::vector<float> wanted = illuminances_of(device, Baked(plain_room()), none);
    // Seeds differ by less than three pixels whose centres lie on the foot of the block: they see the floor below or
    // beside it.
    const double noise = rmse_of(wanted, illuminances_of(device, Baked(plain_room(), 200'000, 2), none));
    const double most = std::max(2 * noise, 0.045);
    char allowed[64];
    std::snprintf(allowed, sizeof allowed, "RMSE <= %.1f %%, bias <= 1 %%", 100 * most);
    for (const Disguise& disguise : disguises) {
        const std::string name = disguise.name;
        const auto holds = [&](const char* part) { return name.find(part) != std::string::npos; };
        if (std::none_of(std::begin(drawn), std::end(drawn), holds)) continue;
        const std::vector<float> got = illuminances_of(device, Baked(disguise.room()), disguise);
        const double rmse = rmse_of(wanted, got), ratio = mean_of(got) / mean_of(wanted);
        tell_case(words_of(name) + ", picture on the device", allowed, "RMSE %.1f %%, bias %+.2f %%", 100 * rmse,
                  100 * (ratio - 1));
        EXPECT_NEAR(ratio, 1, 0.01) << name;
        EXPECT_LE(rmse, most) << name;
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(RobustnessOnADevice, AnyCameraShowsLightThatIsANumber) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Baked baked(plain_room(), 20'000);
    const Bvh bvh = build_bvh(baked.scene);
    const Resident resident(device, baked.scene, baked.map, bvh);
    Renderer renderer(device, resident, 16, 12);
    const Camera eye = baked.scene.cameras[0];
    std::vector<float> middle;
    for (uint mode : modes)  // outermost: each has pipelines of its own
        for (float degrees : {1.0f, 60.0f, 170.0f})
            for (const vec3 moved_by : {vec3(0), vec3(0, 2, 0), vec3(0, -1.6f, 0), vec3(0.8f, 0, 0), vec3(50, 0, 0)}) {
                Camera camera = eye;
                camera.yfov = glm::radians(degrees);
                camera.position += moved_by;  // inside the ceiling, on the floor, on a wall, outside
                RenderSettings settings;
                settings.gather.mode = mode;
                settings.gather.neighbours = 20;
                const Image image = renderer.render(camera, settings).image;
                for (const char* channel : {"R", "G", "B", "illuminance"})
                    for (float v : image.find(channel)->values)
                        ASSERT_TRUE(std::isfinite(v) && v >= 0) << channel << " " << degrees << " " << mode;
                if (moved_by == vec3(0) && mode == gather_mode_cached)
                    middle.push_back(image.find("illuminance")->values[16 * 6 + 8]);
            }
    ASSERT_EQ(middle.size(), 3u);
    tell_case("fields of view of 1, 60 and 170 degrees; cameras in walls, on the floor, outside",
              "light in every pixel", "the middle reads %.1f, %.1f, %.1f lx", double(middle[0]), double(middle[1]),
              double(middle[2]));
    EXPECT_NEAR(middle[0] / middle[1], 1, 0.06);          // the centre of the wider pixel lies half of it aside
    EXPECT_NEAR(std::log2(middle[2] / middle[1]), 0, 1);  // a pixel of 170 degrees is a metre wide there
}

}  // namespace
}  // namespace lw::test
