// Bins of samples, compared with what is expected of them by a chi-square test.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "shaders/types.h"

namespace lw::test {

constexpr double pi = 3.14159265358979323846;

/// Weighted chi-square: counted flux of samples against the expected flux of bins, in standard deviations.
class Bins {
  public:
    explicit Bins(size_t count) : sum_(count, 0), squares_(count, 0), expected_(count, 0) {}
    void count(size_t bin, double flux) { sum_[bin] += flux, squares_[bin] += flux * flux; }
    void expect(size_t bin, double flux) { expected_[bin] += flux; }

    void check(const std::string& what) const {
        double total = 0, chi2 = 0;
        int degrees = -1;
        for (double e : expected_) total += e;
        for (size_t i = 0; i < sum_.size(); ++i) {
            if (expected_[i] < 1e-9 * total) {
                EXPECT_LT(sum_[i], 1e-3 * total) << what << ", bin " << i;
            }
            if (expected_[i] < 1e-4 * total || !(squares_[i] > 0)) continue;
            chi2 += (sum_[i] - expected_[i]) * (sum_[i] - expected_[i]) / squares_[i];
            ++degrees;
        }
        EXPECT_GT(degrees, 10) << what;
        EXPECT_LT(chi2, degrees + 5 * std::sqrt(2.0 * degrees)) << what;
    }

  private:
    std::vector<double> sum_, squares_, expected_;
};

/// Directions in bins of equal solid angle: the cosine to z by the angle around it.
struct DirectionBins {
    static constexpr int rows = 20, columns = 16, fine = 24;
    static size_t bin(vec3 d) {
        const double phi = std::atan2(double(d.y), double(d.x)) / (2 * pi) + 0.5;
        return size_t(std::min(int((double(d.z) + 1) / 2 * rows), rows - 1) * columns +
                      std::min(int(phi * columns), columns - 1));
    }
    /// Calls body(direction, solid angle) for a grid of directions.
    static void for_all(const std::function<void(vec3, double)>& body) {
        for (int r = 0; r < rows * fine; ++r)
            for (int c = 0; c < columns * fine; ++c) {
                const double z = 2 * (r + 0.5) / (rows * fine) - 1, sine = std::sqrt(1 - z * z);
                const double phi = ((c + 0.5) / (columns * fine) - 0.5) * 2 * pi;
                body(vec3(float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(z)),
                     4 * pi / (rows * fine * columns * fine));
            }
    }
};

}  // namespace lw::test
