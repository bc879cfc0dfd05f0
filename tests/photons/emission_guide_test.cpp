// The guide of a sun's photons moves numbers without bias, and to the places that are useful.
#include "photons/emission_guide.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/random.h"

namespace lw {
namespace {

constexpr size_t side = EmissionGuide::side;

using Numbers = std::array<float, 5>;

/// What is useful in proportion to `value(row, column)`.
template <class Value>
EmissionGuide guide_of(const Value& value) {
    std::vector<double> usefulness(side * side);
    for (size_t row = 0; row < side; ++row)
        for (size_t column = 0; column < side; ++column) usefulness[row * side + column] = value(row, column);
    return EmissionGuide(usefulness);
}

/// Bright where the light of two windows leaves the disc, nothing elsewhere.
EmissionGuide two_windows() {
    return guide_of([](size_t row, size_t column) {
        const bool first = row >= 10 && row < 20 && column >= 30 && column < 50;
        const bool second = row >= 40 && row < 44 && column >= 5 && column < 9;
        return first ? 1.0 : second ? 5.0 : 0.0;
    });
}

Numbers random_numbers(Rng& rng) { return {rng.next(), rng.next(), rng.next(), rng.next(), rng.next()}; }

size_t cell_of(const Numbers& u) { return size_t(u[0] * side) * side + size_t(u[1] * side); }

TEST(EmissionGuide, LeavesTheNumbersAsTheyAreBeforeItLearns) {
    const EmissionGuide guide;
    Rng rng(1, 1, 1);
    for (int i = 0; i < 100; ++i) {
        const Numbers before = random_numbers(rng);
        Numbers after = before;
        EXPECT_EQ(guide.warp(after), 1.0f);
        EXPECT_EQ(after, before);
    }
}

TEST(EmissionGuide, IsUniformWhereNothingOrAllIsUseful) {
    for (double value : {0.0, 3.0}) {
        const EmissionGuide guide = guide_of([=](size_t, size_t) { return value; });
        Rng rng(1, 1, 2);
        for (int i = 0; i < 1000; ++i) {
            const Numbers before = random_numbers(rng);
            Numbers after = before;
            EXPECT_NEAR(guide.warp(after), 1, 1e-4);
            for (size_t n = 0; n < after.size(); ++n) EXPECT_NEAR(after[n], before[n], 1e-4);
        }
    }
}

TEST(EmissionGuide, MovesThePlaceAloneAndKeepsItOnTheDisc) {
    const EmissionGuide guide = two_windows();
    Rng rng(1, 1, 3);
    const auto check = [&](const Numbers& before) {
        Numbers after = before;
        const float weight = guide.warp(after);
        EXPECT_TRUE(std::isfinite(weight) && weight > 0);
        for (size_t n = 0; n < 2; ++n) EXPECT_TRUE(after[n] >= 0 && after[n] < 1) << after[n];
        for (size_t n = 2; n < 5; ++n) EXPECT_EQ(after[n], before[n]);
    };
    const float last = 1 - 0x1p-24f;
    for (float u : {0.0f, 0.5f, last})
        for (float v : {0.0f, 0.5f, last}) check({u, v, 0.1f, 0.2f, 0.3f});
    for (int i = 0; i < 10'000; ++i) check(random_numbers(rng));
}

TEST(EmissionGuide, WeightsAverageToOneAndMeansStayWhatTheyWere) {
    const EmissionGuide guide = two_windows();
    constexpr int count = 4'000'000;  // of weights up to 34: the mean scatters by 0.0025
    double weights = 0, mean = 0;
    Rng rng(1, 1, 6);
    for (int i = 0; i < count; ++i) {
        Numbers u = random_numbers(rng);
        const double weight = guide.warp(u);
        weights += weight;
        mean += weight * double(u[0]) * double(u[0]) * std::sin(3 * double(u[1]));
    }
    EXPECT_NEAR(weights / count, 1, 0.01);
    EXPECT_NEAR(mean / count, (1 - std::cos(3.0)) / 9, 0.005);  // the integral of u0^2 sin(3 u1)
}

TEST(EmissionGuide, CellsAreMetAsOftenAsTheWeightsSay) {
    const EmissionGuide guide = two_windows();
    constexpr size_t count = 4'000'000;
    std::vector<double> met(side * side, 0), expected(side * side, 0);
    Rng rng(1, 1, 4);
    for (size_t i = 0; i < count; ++i) {
        Numbers u = random_numbers(rng);
        const float weight = guide.warp(u);
        met[cell_of(u)] += 1;
        expected[cell_of(u)] = double(count) / (double(side * side) * double(weight));
    }
    double chi2 = 0;
    for (size_t c = 0; c < met.size(); ++c) {
        ASSERT_GT(expected[c], 5) << c;  // each was met at least once
        chi2 += (met[c] - expected[c]) * (met[c] - expected[c]) / expected[c];
    }
    const double freedom = double(side * side) - 1;
    EXPECT_NEAR(chi2, freedom, 4 * std::sqrt(2 * freedom));
}

/// Shares of photons in a useful cell and in each of its neighbours, when no other cell is useful.
std::array<double, 9> shares_around(size_t row, size_t column) {
    const EmissionGuide guide = guide_of([=](size_t r, size_t c) { return r == row && c == column ? 1.0 : 0.0; });
    constexpr int count = 200'000;
    std::array<double, 9> shares{};
    Rng rng(1, 1, 5);
    for (int i = 0; i < count; ++i) {
        Numbers u = random_numbers(rng);
        guide.warp(u);
        const size_t r = cell_of(u) / side, c = cell_of(u) % side;
        const size_t down = (r + 1 + side - row) % side, right = (c + 1 + side - column) % side;
        if (down < 3 && right < 3) shares[3 * down + right] += 1.0 / count;
    }
    return shares;
}

TEST(EmissionGuide, SendsPhotonsToOneUsefulCellAndItsNeighboursAlike) {
    constexpr double floor = 0.03 / double(side * side);         // of the mean
    constexpr double expected = (1.0 / 9 + floor) / (1 + 0.03);  // of all photons
    for (size_t column : {40, 0, 63})                            // the second number goes around the disc
        for (double share : shares_around(20, column)) EXPECT_NEAR(share, expected, 0.003) << column;
}

/// The last number, from 0 to 1, at which `weight` is still at most `most`, as it is at `from`.
template <class Weight>
float last_at_most(float most, float from, const Weight& weight) {
    float low = from, high = 1;
    while (std::nextafter(low, 1.0f) < high) {
        const float middle = low + 0.5f * (high - low);
        (weight(middle) <= most ? low : high) = middle;
    }
    return low;
}

TEST(EmissionGuide, TheLastNumberOfACellStaysInIt) {
    for (const size_t useful : {2, 9, 20, 28}) {  // blurred: of the cells around it too
        const EmissionGuide guide =
            guide_of([=](size_t row, size_t column) { return row == useful && column == useful ? 1.0 : 0.0; });
        const auto moved = [&](float u, float v) {
            Numbers numbers{u, v, 0, 0, 0};
            const float weight = guide.warp(numbers);
            return std::pair(numbers, weight);
        };
        const float least = 1.1f * moved(0.5f, 0.5f).second;
        const float u = last_at_most(least, 0.5f, [&](float x) { return moved(x, 0.5f).second; });
        const float v = last_at_most(least, 0.5f, [&](float x) { return moved(0.5f, x).second; });
        EXPECT_LT(moved(u, 0.5f).first[0] * side, float(useful + 2)) << useful;
        EXPECT_LT(moved(0.5f, v).first[1] * side, float(useful + 2)) << useful;
    }
}

}  // namespace
}  // namespace lw
