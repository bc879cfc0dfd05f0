#include "image/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace lw {
namespace {

Image grey(float value, int size = 8) {
    Image image;
    image.width = image.height = size;
    for (const char* name : {"R", "G", "B"}) image.add(name, value);
    return image;
}

TEST(Tonemap, SrgbCodesMatchTheStandard) {
    EXPECT_FLOAT_EQ(encode_srgb_value(0.0f), 0.0f);
    EXPECT_NEAR(encode_srgb_value(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(encode_srgb_value(0.0031308f), 12.92f * 0.0031308f, 1e-6f);
    EXPECT_NEAR(encode_srgb_value(0.0031309f), 12.92f * 0.0031309f, 1e-5f) << "the two pieces meet";
    EXPECT_NEAR(encode_srgb_value(0.21404114f), 0.5f, 1e-5f);
    for (float v = 0.0031309f; v < 1; v += 0.0001f)
        ASSERT_NEAR(encode_srgb_value(v), 1.055 * std::pow(double(v), 1 / 2.4) - 0.055, 3e-6) << v;
}

TEST(Tonemap, OneEvMoreIsHalfAsBright) {
    EXPECT_FLOAT_EQ(exposure_scale(0), 1 / 1.2f);
    EXPECT_FLOAT_EQ(exposure_scale(5), 0.5f * exposure_scale(4));
}

TEST(Tonemap, TheCurveRisesStaysBelowOneAndIsContinuous) {
    float previous = -1;
    for (float v = 0; v < 100; v += 0.001f) {
        float toned = tone_curve(vec3(v)).x;
        ASSERT_GE(toned, previous - 1e-6f) << v;
        ASSERT_LT(toned - previous, v == 0 ? 1.1f : 0.0021f) << v;
        ASSERT_LE(toned, 1.0f);
        previous = toned;
    }
}

TEST(Tonemap, MidTonesKeepTheirHueAndValue) {
    vec3 colour(0.6f, 0.4f, 0.2f), toned = tone_curve(colour);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(toned[c], colour[c] - 0.04f, 1e-6f);
}

TEST(Tonemap, AutomaticExposurePutsAnEvenRoomAtAFifth) {
    float ev = auto_exposure_ev(grey(120.0f));
    EXPECT_NEAR(120.0f * exposure_scale(ev), 0.2f, 1e-4f);
    EXPECT_EQ(auto_exposure_ev(grey(0.0f)), 0.0f);
}

TEST(Tonemap, AFewHotPixelsDoNotMoveTheExposure) {
    Image image = grey(100.0f, 32);
    for (Channel& c : image.channels) c.values[5] = 1e7f;
    EXPECT_NEAR(auto_exposure_ev(image), auto_exposure_ev(grey(100.0f)), 1e-3f);
}

TEST(Tonemap, InfinityIsWhiteNegativeBlackNotANumberMagenta) {
    Image image = grey(0.0f, 2);
    for (Channel& c : image.channels) {
        c.values[0] = std::numeric_limits<float>::infinity();
        c.values[1] = -5.0f;
        c.values[2] = std::numeric_limits<float>::quiet_NaN();
    }
    Rgb8Image result = tonemap(image, 0);
    std::vector<uint8_t> first(result.rgb.begin(), result.rgb.begin() + 9);
    EXPECT_EQ(first, (std::vector<uint8_t>{255, 255, 255, 0, 0, 0, 255, 0, 255}));
}

TEST(Tonemap, AMissingChannelIsNamed) {
    Image image;
    image.width = image.height = 1;
    image.add("R");
    EXPECT_THROW(tonemap(image, 0), Error);
}

}  // namespace
}  // namespace lw
