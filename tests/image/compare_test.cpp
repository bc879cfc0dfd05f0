#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/flip.h"

namespace lw {
namespace {

/// A smooth picture between 50 and 150 cd/m2, times `factor`.
Image gradient(float factor, int width = 48, int height = 32) {
    Image image;
    image.width = width;
    image.height = height;
    for (const char* name : {"R", "G", "B", "illuminance"}) {
        std::vector<float>& values = image.add(name);
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = factor * (50 + 100 * float(i % size_t(width)) / float(width - 1));
    }
    return image;
}

std::string error_of(const Image& picture, const Image& reference, const std::string& channel = "") {
    try {
        compare(picture, reference, channel);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(Compare, APictureEqualsItself) {
    Comparison c = compare(gradient(1), gradient(1));
    EXPECT_DOUBLE_EQ(c.mean_ratio, 1);
    EXPECT_EQ(c.bias, 0);
    EXPECT_EQ(c.rmse_relative, 0);
    EXPECT_EQ(c.rel_mse, 0);
    EXPECT_EQ(c.flip, 0);
    EXPECT_EQ(c.p95_relative_error, 0);
}

TEST(Compare, AConstantRatioIsFoundByEveryMeasure) {
    Comparison c = compare(gradient(1.1f), gradient(1));
    EXPECT_NEAR(c.mean_ratio, 1.1, 1e-5);
    EXPECT_NEAR(c.bias, 0.1, 1e-5);
    EXPECT_NEAR(c.p95_relative_error, 0.1, 1e-4);
    EXPECT_NEAR(c.reference_mean, 100, 1e-3);
    double squares = 0;
    for (int x = 0; x < 48; ++x) squares += std::pow(50 + 100 * x / 47.0, 2) / 48;
    EXPECT_NEAR(c.rmse_relative, 0.1 * std::sqrt(squares) / 100, 1e-5);
    EXPECT_GT(c.rel_mse, 0.009);
    EXPECT_LT(c.rel_mse, 0.01);
    EXPECT_GT(c.flip, 0);
    EXPECT_LT(c.flip, 0.2);
}

TEST(Compare, TheBlurForgivesNoiseAndRmseDoesNot) {
    Image noisy = gradient(1);
    for (Channel& channel : noisy.channels)
        for (size_t i = 0; i < channel.values.size(); ++i) channel.values[i] *= (i + i / 48) % 2 ? 1.2f : 0.8f;
    Comparison c = compare(noisy, gradient(1));
    EXPECT_GT(c.rmse_relative, 0.19);
    EXPECT_LT(c.p95_relative_error, 0.02);
}

TEST(Compare, ASingleChannelIsComparedByName) {
    Image picture = gradient(1);
    for (float& v : picture.channels[3].values) v *= 2;
    EXPECT_NEAR(compare(picture, gradient(1), "illuminance").mean_ratio, 2, 1e-6);
    EXPECT_NEAR(compare(picture, gradient(1)).mean_ratio, 1, 1e-6);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    EXPECT_EQ(error_of(gradient(1, 8, 8), gradient(1, 8, 9)), "picture is 8x8, reference is 8x9");
    EXPECT_NE(error_of(gradient(1), gradient(1), "depth").find("\"depth\""), std::string::npos);
    EXPECT_NE(error_of(gradient(1), gradient(0)).find("black"), std::string::npos);
    Image broken = gradient(1);
    broken.channels[1].values[48 * 2 + 5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error_of(broken, gradient(1)), "picture: channel \"G\": pixel (5, 2) is not finite");
}

TEST(Compare, RatiosBeyondTheFloatsAreNumbers) {
    const Comparison c = compare(gradient(1), gradient(1e-42f));
    for (const double value : {c.mean_ratio, c.bias, c.rmse_relative, c.rel_mse, c.p95_relative_error, c.flip})
        EXPECT_TRUE(std::isfinite(value)) << value;
}

TEST(Compare, TheDifferencePictureIsRedAboveBlueBelowBlackWhereEqual) {
    Image picture = gradient(1);
    for (Channel& channel : picture.channels) channel.values[0] *= 2, channel.values[1] *= 0.5f;
    Rgb8Image d = difference_picture(picture, gradient(1));
    EXPECT_EQ(d.rgb[0], 255);
    EXPECT_EQ(d.rgb[2], 0);
    EXPECT_EQ(d.rgb[3], 0);
    EXPECT_EQ(d.rgb[5], 255);
    EXPECT_EQ(d.rgb[6] + d.rgb[7] + d.rgb[8], 0);
}

float mean_flip(const vec3& test, const vec3& reference) {
    std::vector<vec3> a(32 * 32, test), b(32 * 32, reference);
    double sum = 0;
    for (float v : flip(a, b, 32, 32)) sum += double(v);
    return float(sum / (32 * 32));
}

TEST(Flip, IsZeroForEqualAndNearOneForBlackAgainstWhite) {
    EXPECT_EQ(mean_flip(vec3(0.3f), vec3(0.3f)), 0);
    // By hand: HyAB is 100, 100^0.7 = 25.12, the largest 41.28, its knee 16.51: 0.95 + 0.05 * 8.61 / 24.77.
    EXPECT_NEAR(mean_flip(vec3(0), vec3(1)), 0.9674f, 1e-3f);
}

TEST(Flip, BlueAgainstGreenIsTheLargestDifference) { EXPECT_NEAR(mean_flip({0, 0, 1}, {0, 1, 0}), 1, 1e-4f); }

TEST(Flip, FineNoiseIsSeenLessThanTheSameDifferenceInLargeAreas) {
    std::vector<vec3> flat(64 * 64, vec3(0.3f)), noise = flat, halves = flat;
    for (size_t i = 0; i < flat.size(); ++i) {
        noise[i] = vec3((i + i / 64) % 2 ? 0.35f : 0.25f);
        halves[i] = vec3(i % 64 < 32 ? 0.35f : 0.25f);
    }
    auto mean = [&](const std::vector<vec3>& test) {
        double sum = 0;
        for (float v : flip(test, flat, 64, 64)) sum += double(v);
        return sum / 4096;
    };
    EXPECT_LT(mean(noise), 0.5 * mean(halves));
}

}  // namespace
}  // namespace lw
