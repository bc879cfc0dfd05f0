// Directions that sample_bsdf() picks against the pdf that bsdf_pdf() tells.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw::test {

/// Bins of equal solid angle: the cosine to z from `low` to 1 in rows, the angle around z in columns.
struct ChiSquare {
    float low;  // 0: the upper half of directions; -1: all
    int rows, columns, samples;
    double sum = 0;    // after test(): the chi-square
    int degrees = -1;  // after test(): its degrees of freedom

    /// Samples a surface seen from unit `view`.
    void test(const SurfaceReader& reader, const Surface& s, vec3 view) {
        const std::vector<double> counted = count(reader, s, view), expected = expect(reader, s, view);
        for (size_t i = 0; i < counted.size(); ++i) {
            if (expected[i] < 20) continue;
            sum += (counted[i] - expected[i]) * (counted[i] - expected[i]) / expected[i];
            ++degrees;
        }
    }

  private:
    std::vector<double> count(const SurfaceReader& reader, const Surface& s, vec3 view) const {
        std::vector<double> counted(size_t(rows * columns), 0);
        Rng rng(7, 1, 0);
        for (int i = 0; i < samples; ++i) {
            const auto next = sample_bsdf(reader, s, view, Carries::radiance, rng);
            if (!next || next->specular) continue;
            const int row = std::clamp(int((next->direction.z - low) / (1 - low) * float(rows)), 0, rows - 1);
            const double phi = std::atan2(double(next->direction.y), double(next->direction.x)) / (2 * M_PI) + 0.5;
            ++counted[size_t(row * columns + std::min(int(phi * columns), columns - 1))];
        }
        return counted;
    }
    std::vector<double> expect(const SurfaceReader& reader, const Surface& s, vec3 view) const {
        constexpr int fine = 24;  // points of a bin, along each side
        const double height = 1 - double(low), solid_angle = height * 2 * M_PI / (rows * fine * columns * fine);
        std::vector<double> expected(size_t(rows * columns), 0);
        for (int r = 0; r < rows * fine; ++r)
            for (int c = 0; c < columns * fine; ++c) {
                const double z = (r + 0.5) / (rows * fine) * height + double(low), sine = std::sqrt(1 - z * z);
                const double phi = ((c + 0.5) / (columns * fine) - 0.5) * 2 * M_PI;
                const vec3 to_light(float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(z));
                expected[size_t((r / fine) * columns + c / fine)] +=
                    double(bsdf_pdf(reader, s, view, to_light)) * solid_angle * samples;
            }
        return expected;
    }
};

}  // namespace lw::test
