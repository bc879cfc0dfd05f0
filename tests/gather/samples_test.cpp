// The views of a still: how far they are from the truth, and when they are enough.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gather/renderer.h"
#include "maps/bake.h"
#include "programs/lavapipe.h"
#include "scene/gltf.h"
#include "shaders/color.h"
#include "trace/build_bvh.h"
#include "trace/ray_caster.h"

namespace lw {
namespace {

/// The Cornell box, whose soft shadows are sampled anew in each view.
struct Box {
    Box()
        : scene(load_gltf(LUMENWALK_SOURCE_DIR "/data/cornell.gltf")),
          caster(scene),
          map(bake(scene, caster, {.photons = 50'000})) {}

    Rendering render(const Device& device, RenderSettings settings) const {
        const Bvh bvh = build_bvh(scene);
        const Resident resident(device, scene, map, bvh);
        return Renderer(device, resident, 64, 64).render(scene.cameras[0], settings);
    }

    Scene scene;
    RayCaster caster;
    PhotonMap map;
};

std::vector<double> luminances(const Image& image) {
    std::vector<double> values;
    for (size_t i = 0; i < image.pixel_count(); ++i)
        values.push_back(double(
            luminance(vec3(image.find("R")->values[i], image.find("G")->values[i], image.find("B")->values[i]))));
    return values;
}

/// RMS difference in parts of the mean of `b`, whose lamps count at eight times it.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double mean = 0, squares = 0;
    for (double l : b) mean += l / double(b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        const double d = std::min(a[i], 8 * mean) - std::min(b[i], 8 * mean);
        squares += d * d / double(a.size());
    }
    return std::sqrt(squares) / mean;
}

TEST(Samples, TheirErrorIsEstimated) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Box box;
    const Rendering truth = box.render(device, {.samples = 2048});
    for (uint samples : {16u, 64u}) {
        const Rendering picture = box.render(device, {.samples = samples});
        ASSERT_TRUE(picture.error.has_value());
        EXPECT_EQ(picture.samples, samples);
        const double actual = difference(luminances(picture.image), luminances(truth.image));
        EXPECT_GT(double(*picture.error), 0.5 * actual) << samples;
        EXPECT_LT(double(*picture.error), 2.5 * actual) << samples;
    }
    EXPECT_FALSE(box.render(device, {.samples = 4}).error.has_value());
}

TEST(Samples, EndOnceTheErrorIsSmallEnough) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Box box;
    const Rendering all = box.render(device, {.exposure_ev = 7.0f, .samples = 64});
    const Rendering some = box.render(device, {.exposure_ev = 7.0f, .samples = 1024, .error = 1.01f * *all.error});
    EXPECT_EQ(some.samples, 64u);
    EXPECT_LT(difference(luminances(some.image), luminances(all.image)), 1e-5);
    int largest_step = 0;  // of the screen, whose exposure makes up for the samples that were left out
    for (size_t i = 0; i < all.screen.rgb.size(); ++i)
        largest_step = std::max(largest_step, std::abs(int(all.screen.rgb[i]) - int(some.screen.rgb[i])));
    EXPECT_LE(largest_step, 1);
}

}  // namespace
}  // namespace lw
