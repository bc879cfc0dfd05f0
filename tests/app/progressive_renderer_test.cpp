// The walkthrough's picture without a window: the same light as the renderer's, A beside B, values behind the colours.
#include "app/picture/progressive_renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/picture/exposure.h"
#include "app/room.h"
#include "gather/renderer.h"
#include "programs/lavapipe.h"

namespace lw {
namespace {

constexpr vk::Extent2D size{96, 128};  // of the room's pictures; a band begins with a sixteenth of the rows, 8 of them

/// Largest difference of a channel of two screens over columns [first, end).
int largest_difference(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b, uint first, uint end) {
    int largest = 0;
    for (uint y = 0; y < size.height; ++y)
        for (uint x = first; x < end; ++x)
            for (int shift : {0, 8, 16}) {
                const size_t i = y * size.width + x;
                largest = std::max(largest, std::abs(int(a[i] >> shift & 255u) - int(b[i] >> shift & 255u)));
            }
    return largest;
}

uint32_t code_of(vec3 srgb) {
    uint32_t code = 0xff000000u;
    for (int c = 0; c < 3; ++c) code |= uint32_t(srgb[c] * 255 + 0.5f) << (8 * c);
    return code;
}

TEST(ProgressiveRenderer, ShowsWhatTheRendererShows) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    const std::vector<uint32_t> seen = room.frame({{}, 5});
    Resident resident(room.device, room.world.scene, *room.map, room.world.bvh);
    Renderer renderer(room.device, resident, size.width, size.height);
    const Rendering expected = renderer.render(room.request.camera, {{}, 5.0f, 1, 1});
    for (size_t i = 0; i < seen.size(); ++i)
        for (size_t c = 0; c < 3; ++c) ASSERT_EQ(seen[i] >> (8 * c) & 255u, expected.screen.rgb[3 * i + c]) << i;
    const Image values = room.renderer.read_values();
    for (const Channel& channel : expected.image.channels)
        EXPECT_EQ(channel.values, values.find(channel.name)->values) << channel.name;
    EXPECT_EQ(room.device.validation_messages(), std::vector<std::string>{});
}

TEST(ProgressiveRenderer, SplitsThePictureBetweenALeftAndBRight) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    const std::vector<uint32_t> a = room.frame({{}, 5});
    room.request.factors_a = {vec3(0.3f, 0.2f, 0.1f)};
    const std::vector<uint32_t> b = room.frame({{}, 5});
    ASSERT_GT(largest_difference(a, b, 0, size.width), 30);
    room.request.factors_a = {vec3(1)};
    room.request.factors_b = {vec3(0.3f, 0.2f, 0.1f)};
    DisplaySettings display{{}, 5};
    display.kind.has_split = true;
    display.split = 0.5f;
    const std::vector<uint32_t> split = room.frame(display);
    EXPECT_EQ(largest_difference(split, a, 0, size.width / 2 - 1), 0);
    EXPECT_EQ(largest_difference(split, b, size.width / 2 + 1, size.width), 0);
    EXPECT_EQ(split[size.width / 2], 0xffffffffu) << "the edge";
    EXPECT_EQ(room.device.validation_messages(), std::vector<std::string>{});
}

TEST(ProgressiveRenderer, ColoursAreThoseOfTheValuesBehindThem) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.request.factors_b = {vec3(0.5f)};
    for (uint view : {view_illuminance, view_luminance, view_difference, view_relative_difference}) {
        DisplaySettings display{{view}, 5};
        display.low = is_signed_view(view) ? -60.0f : 1.0f;
        display.high = is_signed_view(view) ? 60.0f : 200.0f;
        display.logarithmic = view == view_luminance;
        const std::vector<uint32_t> seen = room.frame(display);
        const Image values = room.renderer.read_values();
        for (size_t i = 0; i < seen.size(); i += 7) {
            const auto at = [&](const char* name) { return values.find(name)->values[i]; };
            if (at("depth") <= 0) continue;
            float value = at("illuminance");
            if (view == view_luminance) value = 0.2126f * at("R") + 0.7152f * at("G") + 0.0722f * at("B");
            if (view == view_difference) value *= -0.5f;
            if (view == view_relative_difference) value = value > 1e-4f ? -50.0f : 0.0f;
            const uint32_t expected = code_of(view_color(view, value, display.low, display.high, display.logarithmic));
            for (int shift : {0, 8, 16})
                EXPECT_NEAR(double(seen[i] >> shift & 255u), double(expected >> shift & 255u), 3) << view << " " << i;
        }
    }
}

TEST(ProgressiveRenderer, TintedLampsTintThePicture) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.frame({{}, 5});
    const Image white = room.renderer.read_values();
    room.request.factors_a = {vec3(1, 0.5f, 0)};
    room.frame({{}, 5});
    const Image tinted = room.renderer.read_values();
    for (size_t i = 0; i < white.pixel_count(); ++i) {
        const float r = white.find("R")->values[i], g = white.find("G")->values[i];
        EXPECT_NEAR(tinted.find("R")->values[i], r, 0.004f * std::max(r, g) + 1e-3f);  // nodes share an exponent
        EXPECT_NEAR(tinted.find("G")->values[i], 0.5f * g, 0.004f * std::max(r, g) + 1e-3f);
        EXPECT_EQ(tinted.find("B")->values[i], 0);
    }
}

TEST(ProgressiveRenderer, AddsUpSamplesWhileStillAndStartsAnewWhenTheLampsChange) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.request.max_samples = 4;
    for (uint i = 1; i <= 6; ++i) {
        EXPECT_EQ(room.renderer.is_finished(room.request), i > 4);
        room.frame({{}, 5});
        EXPECT_EQ(room.renderer.samples(), std::min(i, 4u));
    }
    Resident resident(room.device, room.world.scene, *room.map, room.world.bvh);
    Renderer renderer(room.device, resident, size.width, size.height);
    const Image many = renderer.render(room.request.camera, {{}, 5.0f, 64, 1}).image;
    const Image one = renderer.render(room.request.camera, {{}, 5.0f, 1, 1}).image;
    const Image four = room.renderer.read_values();
    double error_one = 0, error_four = 0;
    for (size_t i = 0; i < many.pixel_count(); ++i) {
        const double truth = double(many.find("illuminance")->values[i]);
        error_one += std::pow(double(one.find("illuminance")->values[i]) - truth, 2);
        error_four += std::pow(double(four.find("illuminance")->values[i]) - truth, 2);
    }
    EXPECT_LT(error_four, 0.6 * error_one);
    room.request.factors_a = {vec3(0.9f)};
    EXPECT_FALSE(room.renderer.is_finished(room.request));
    room.frame({{}, 5});
    EXPECT_EQ(room.renderer.samples(), 1u);
}

TEST(ProgressiveRenderer, AddsASlowSampleInBandsAndThePictureIsTheSame) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.request.max_samples = 3;
    const std::vector<uint32_t> first = room.frame({{}, 5});
    const std::vector<uint32_t> second = room.frame({{}, 5});
    const Image whole = room.renderer.read_values();
    room.renderer.forget();
    room.request.max_ms = 1e-6;  // as few rows as there can be
    EXPECT_EQ(room.frame({{}, 5}), first) << "the first sample comes whole";
    std::vector<uint32_t> seen;
    const uint bands = size.height / 8;
    for (uint band = 0; band < bands; ++band) {
        EXPECT_EQ(room.renderer.samples(), 1u);
        seen = room.frame({{}, 5});
        if (band > 0) continue;
        const std::vector<uint32_t> top(seen.begin(), seen.begin() + 8 * size.width),
            bottom(seen.begin() + 16 * size.width, seen.end());
        EXPECT_TRUE(std::equal(top.begin(), top.end(), second.begin()));
        EXPECT_TRUE(std::equal(bottom.begin(), bottom.end(), first.begin() + 16 * size.width));
        const std::vector<float> lux = room.renderer.read_values().find("illuminance")->values;
        EXPECT_TRUE(std::equal(lux.begin(), lux.begin() + 8 * size.width, whole.find("illuminance")->values.begin()));
    }
    EXPECT_EQ(room.renderer.samples(), 2u);
    EXPECT_EQ(seen, second);
    EXPECT_EQ(room.renderer.read_values().find("R")->values, whole.find("R")->values);
    room.request.camera.position.x += 0.1f;
    room.frame({{}, 5});
    room.frame({{}, 5});
    room.request.camera.position.x -= 0.1f;
    EXPECT_EQ(room.frame({{}, 5}), first) << "what a band added to another view is gone";
    room.request.max_ms = 1e6;
    room.frame({{}, 5});
    EXPECT_EQ(room.renderer.times(0).rows, 8u) << "the cost of another view says nothing of this one";
    room.frame({{}, 5});
    EXPECT_EQ(room.renderer.times(0).rows, 16u) << "at most twice the rows of the band before";
}

TEST(ProgressiveRenderer, BandsOfAComparisonEndInTheSamePicture) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.request.max_samples = 2;
    room.request.factors_b = {vec3(0.3f, 0.2f, 0.1f)};
    DisplaySettings display{{}, 5};
    display.kind.has_split = true;
    const std::vector<uint32_t> first = room.frame(display), second = room.frame(display);
    ASSERT_NE(first, second);
    room.renderer.forget();
    room.request.max_ms = 1e-6;
    EXPECT_EQ(room.frame(display), first);
    std::vector<uint32_t> seen;
    for (uint band = 0; band < size.height / 8; ++band) {
        ASSERT_FALSE(room.renderer.is_finished(room.request)) << band;
        seen = room.frame(display);
    }
    EXPECT_TRUE(room.renderer.is_finished(room.request));
    EXPECT_EQ(seen, second);
}

TEST(ProgressiveRenderer, InMotionHasFewerPixelsAndSharpensWhenStill) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    const std::vector<uint32_t> whole = room.frame({{}, 5});
    room.renderer.forget();
    room.request.divisor = 3;
    room.request.max_samples = 1;
    const std::vector<uint32_t> coarse = room.frame({{}, 5});
    EXPECT_EQ(room.renderer.read_values().width, int(size.width / 3));
    EXPECT_GT(largest_difference(whole, coarse, 0, size.width), 20);
    EXPECT_FALSE(room.renderer.is_finished(room.request));
    EXPECT_EQ(largest_difference(whole, room.frame({{}, 5}), 0, size.width), 0);
    EXPECT_TRUE(room.renderer.is_finished(room.request));
}

TEST(ProgressiveRenderer, InspectsWhatTheSmoothEstimateStandsOn) {
    SKIP_WITHOUT_LAVAPIPE();
    Room room;
    room.request.gather.neighbours = 20;
    const auto readback_of = [&](uint view) {
        room.frame({{view}, 5});
        double sum = 0, count = 0;
        for (const ReadbackPixel& g : room.renderer.readback(0, view))
            if (g.seen > 0 && g.illuminance > 1) sum += double(g.value), count += 1;
        return sum / count;
    };
    EXPECT_NEAR(readback_of(view_photon_count), 20, 8);
    const double error = readback_of(view_error);
    EXPECT_GT(error, 2);  // about 1.15 / sqrt(20) of the reflected part
    EXPECT_LT(error, 28);
    const double bandwidth = readback_of(view_bandwidth);
    room.request.gather.neighbours = 80;
    EXPECT_GT(readback_of(view_bandwidth), 1.5 * bandwidth);
    EXPECT_LT(readback_of(view_error), 0.7 * error);
    EXPECT_EQ(room.device.validation_messages(), std::vector<std::string>{});
}

TEST(Adapt, RangesAreRoundAndSignedOnesEven) {
    std::vector<float> values;
    for (int i = 0; i <= 100; ++i) values.push_back(float(i) * 4.4f);
    EXPECT_EQ(range_of(values, view_illuminance, false), vec2(0, 500));
    EXPECT_EQ(range_of(values, view_illuminance, true), vec2(5, 500));
    EXPECT_EQ(range_of({-3, 1, 2, -17}, view_difference, false), vec2(-20, 20));
    EXPECT_EQ(range_of({}, view_illuminance, false), vec2(0, 1));
    std::vector<float> sunlit(100, 100.0f);
    for (int i = 0; i < 10; ++i) sunlit[size_t(i)] = 9000;
    EXPECT_EQ(range_of(sunlit, view_illuminance, false), vec2(0, 500)) << "a patch of sun must not drown the room";
}

TEST(Adapt, DividesThePictureOnlyAsMuchAsItsTimeAsksAndGetsFinerOnlyWhenStill) {
    DynamicResolution divisor;
    RendererTimes last;
    EXPECT_EQ(divisor.next(0, last, true), 4u) << "no frame has told anything yet";
    last = {0, 700, 0, 1, 0, true};
    EXPECT_EQ(divisor.next(0, last, true), 4u);
    last = {0, 10, 0, 4, 0, true};
    EXPECT_EQ(divisor.next(0, last, false), 4u) << "no change of size while moving";
    last = {0, 20, 0, 1, 0, true};
    EXPECT_EQ(divisor.next(0, last, true), 1u);
    EXPECT_EQ(divisor.next(2, last, true), 2u) << "the user's choice";
    last = {40, 110, 6, 1, 0, true};
    EXPECT_EQ(divisor.next(0, last, true), 3u);
    last = {20, 105, 6, 1, 0, true};
    EXPECT_EQ(divisor.next(0, last, true), 2u);
    last = {20, 8, 6, 2, 0, true};
    EXPECT_EQ(divisor.next(0, last, true), 1u) << "the gather of all pixels takes four times as long";
    last = {30, 45, 6, 1, 0, true};
    EXPECT_EQ(divisor.next(0, last, false), 1u) << "a little late";
    last.gather_ms = 60;
    EXPECT_EQ(divisor.next(0, last, false), 2u);
    last = {20, 500, 6, 1, 64, true};
    EXPECT_EQ(divisor.next(0, last, true), 2u) << "a band of a still picture tells nothing of motion";
}

}  // namespace
}  // namespace lw
