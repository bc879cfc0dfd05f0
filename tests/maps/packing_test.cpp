// The encoders of packed records against the decoders that the shaders share.
#include "maps/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "shaders/scene.h"

namespace lw {
namespace {

uint random_word(Rng& rng) { return uint(rng.next() * 65536) << 16 | uint(rng.next() * 65536); }

vec3 random_direction(Rng& rng) {
    const float z = 2 * rng.next() - 1, r = std::sqrt(1 - z * z), phi = 2 * lw_pi * rng.next();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(PackedColor, KeepsEveryValueThatHasACode) {
    Rng rng(1, 1, 1);
    for (int i = 0; i < 200'000; ++i) {
        const vec3 color = unpack_rgb9e5(random_word(rng));
        ASSERT_EQ(unpack_rgb9e5(pack_rgb9e5(color)), color) << color.x << " " << color.y << " " << color.z;
    }
}

TEST(PackedColor, IsRoundedToTheNearestOfTheStepsOfItsLargestChannel) {
    Rng rng(1, 1, 2);
    for (int i = 0; i < 200'000; ++i) {
        const float scale = std::exp2(36 * rng.next() - 22);
        const vec3 color = scale * vec3(rng.next(), rng.next(), rng.next());
        const double top = std::max({color.x, color.y, color.z});
        double step = 0x1p-24;
        while (top >= 511.5 * step) step *= 2;
        const vec3 got = unpack_rgb9e5(pack_rgb9e5(color));
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(double(got[c]) - double(color[c])), 0.5 * step) << color[c];
    }
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(0.9995f))), vec3(1));  // 511.7 of 512 steps
}

TEST(PackedColor, NoLightIsBlackAndTooMuchIsTheBrightest) {
    const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
    EXPECT_EQ(pack_rgb9e5(vec3(0)), 0u);
    EXPECT_EQ(pack_rgb9e5(vec3(nan, -1, -infinite)), 0u);
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(-1, 0.5f, nan))), vec3(0, 0.5f, 0));
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(1e9f, infinite, 65408))), vec3(65408));
}

TEST(PackedDirection, KeepsEveryDirectionThatHasACode) {
    for (uint y = 0; y <= 254; ++y)
        for (uint x = 0; x <= 254; ++x) {
            const vec3 direction = unpack_direction(x | y << 8);
            ASSERT_NEAR(length(direction), 1, 1e-6);
            const vec3 again = unpack_direction(pack_direction(direction, vec2(0.5f)));
            ASSERT_LT(length(again - direction), 1e-5) << x << " " << y;
        }
}

TEST(PackedDirection, IsOneOfTheCodesAroundItWhateverTheDither) {
    Rng rng(1, 1, 3);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 direction = random_direction(rng);
        const vec3 got = unpack_direction(pack_direction(direction, vec2(rng.next(), rng.next())));
        ASSERT_GT(dot(got, direction), std::cos(glm::radians(1.9f)));
    }
}

TEST(PackedDirection, IsRightInTheMeanOfTheDither) {
    Rng rng(1, 1, 4);
    for (int i = 0; i < 2'000; ++i) {
        const vec3 direction = random_direction(rng);
        vec3 mean(0);
        for (int k = 0; k < 256; ++k)
            mean +=
                unpack_direction(pack_direction(direction, vec2(float(k % 16) + 0.5f, float(k / 16) + 0.5f) / 16.0f));
        ASSERT_LT(length(normalize(mean) - direction), glm::radians(0.15f));
    }
}

TEST(PackedDirection, TheAxesStayWhatTheyAre) {
    for (int axis = 0; axis < 3; ++axis)
        for (float end : {-1.0f, 1.0f}) {
            vec3 direction(0);
            direction[axis] = end;
            EXPECT_EQ(unpack_direction(pack_direction(direction, vec2(0.5f))), direction);
        }
}

}  // namespace
}  // namespace lw
