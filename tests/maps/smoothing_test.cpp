// The bilateral filter over lattice nodes: takes the noise of an estimate, leaves gradients and edges.
#include "maps/smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace lw {
namespace {

constexpr uint columns = 60, rows = 40;

/// A lattice with `value(x, y)` at its nodes.
template <class Value>
LatticePlanes plane_of(const Value& value) {
    LatticePlanes plane(columns, rows, 1);
    for (uint y = 0; y < rows; ++y)
        for (uint x = 0; x < columns; ++x) plane.row(0, int(y))[x] = float(value(x, y));
    return plane;
}

LatticePlanes everywhere() {
    return plane_of([](uint, uint) { return 1; });
}

LatticePlanes smooth(const LatticePlanes& plane, const LatticePlanes& existence = everywhere()) {
    return lw::smooth(plane, plane, existence);
}

/// 1 with noise of about a normal distribution: 12 uniform numbers.
LatticePlanes noisy(float relative) {
    return plane_of([=](uint x, uint y) {
        Rng rng(1, x, y);
        float sum = -6;
        for (int i = 0; i < 12; ++i) sum += rng.next();
        return 1 + relative * sum;
    });
}

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments_of(const LatticePlanes& plane) {
    Moments m;
    for (uint y = 0; y < rows; ++y)
        for (uint x = 0; x < columns; ++x) m.mean += double(plane.row(0, int(y))[x]) / (columns * rows);
    for (uint y = 0; y < rows; ++y)
        for (uint x = 0; x < columns; ++x)
            m.variance += std::pow(double(plane.row(0, int(y))[x]) - m.mean, 2) / (columns * rows);
    return m;
}

TEST(Smoothing, KeepsConstantsUpToTheRim) {
    for (float value : {1e-6f, 1.0f, 3e4f}) {
        const LatticePlanes after = smooth(plane_of([=](uint, uint) { return value; }));
        for (uint y = 0; y < rows; ++y)
            for (uint x = 0; x < columns; ++x)
                ASSERT_NEAR(after.row(0, int(y))[x], value, 1e-5f * value) << x << "," << y;
    }
}

TEST(Smoothing, DarknessStaysDark) {
    const LatticePlanes after = smooth(plane_of([](uint, uint) { return 0; }));
    for (uint y = 0; y < rows; ++y)
        for (uint x = 0; x < columns; ++x) ASSERT_EQ(after.row(0, int(y))[x], 0) << x << "," << y;
}

TEST(Smoothing, NodesThatDoNotExistDoNotCount) {
    const auto is_hole = [](uint x, uint y) { return (x * 7 + y * 3) % 5 == 0; };
    const LatticePlanes light = plane_of([&](uint x, uint y) { return is_hole(x, y) ? 2.04f : 2.0f; });
    const LatticePlanes after = smooth(light, plane_of([&](uint x, uint y) { return is_hole(x, y) ? 0 : 1; }));
    for (uint y = 0; y < rows; ++y)
        for (uint x = 0; x < columns; ++x)
            if (!is_hole(x, y)) {
                ASSERT_NEAR(after.row(0, int(y))[x], 2, 1e-5) << x << "," << y;
            }
}

TEST(Smoothing, BringsTheNoiseOf300PhotonsToAThirdAndKeepsTheMean) {
    const LatticePlanes before = noisy(1 / std::sqrt(300.0f));
    const Moments noise = moments_of(before), rest = moments_of(smooth(before));
    EXPECT_NEAR(noise.variance, 1.0 / 300, 0.1 / 300);
    EXPECT_LT(rest.variance, noise.variance / 9);
    EXPECT_NEAR(rest.mean, noise.mean, 1e-3);
}

TEST(Smoothing, KeepsStepsThatAreLargerThanTheNoise) {
    for (bool along_rows : {false, true}) {
        const auto value = [=](uint x, uint y) { return (along_rows ? y < rows / 2 : x < columns / 2) ? 1.0f : 2.0f; };
        const LatticePlanes after = smooth(plane_of(value));
        for (uint y = 0; y < rows; ++y)
            for (uint x = 0; x < columns; ++x) ASSERT_NEAR(after.row(0, int(y))[x], value(x, y), 1e-4) << x << "," << y;
    }
}

TEST(Smoothing, KeepsSlowGradients) {
    const auto value = [](uint x, uint y) { return std::exp(0.01f * float(x) - 0.007f * float(y)); };
    const LatticePlanes after = smooth(plane_of(value));
    constexpr uint border = LatticePlanes::border;
    for (uint y = border; y < rows - border; ++y)
        for (uint x = border; x < columns - border; ++x)
            ASSERT_NEAR(after.row(0, int(y))[x] / value(x, y), 1, 1e-3) << x << "," << y;
}

TEST(Smoothing, IsTheSameMeanForAllPlanesOfLight) {
    const LatticePlanes brightness = noisy(0.06f);
    LatticePlanes light(columns, rows, 3);
    for (int y = 0; y < int(rows); ++y)
        for (uint x = 0; x < columns; ++x) {
            Rng rng(2, x, uint(y));
            light.row(0, y)[x] = rng.next(), light.row(1, y)[x] = 10 * rng.next();
            light.row(2, y)[x] = light.row(0, y)[x] + 2 * light.row(1, y)[x];
        }
    const LatticePlanes after = lw::smooth(light, brightness, everywhere());
    for (int y = 0; y < int(rows); ++y)
        for (uint x = 0; x < columns; ++x)
            ASSERT_NEAR(after.row(2, y)[x], after.row(0, y)[x] + 2 * after.row(1, y)[x], 1e-4) << x << "," << y;
}

}  // namespace
}  // namespace lw
