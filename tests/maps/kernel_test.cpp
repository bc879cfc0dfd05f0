// The kernel of shaders/kernel.h against what is asked of any kernel, and its forms against each other.
#include "shaders/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps/kernel_weight.h"

namespace lw {
namespace {

TEST(Kernel, IntegratesToOneOverItsDisc) {
    for (const float radius : {0.01f, 0.5f, 3.0f}) {
        const double r = double(radius);
        constexpr int rings = 20000;
        double sum = 0;
        for (int i = 0; i < rings; ++i) {
            const double distance = r * (i + 0.5) / rings, width = r / rings;
            const auto part = float(distance * distance / (r * r));
            sum += double(kernel_shape(part)) * 2 * double(lw_pi) * distance * width;
        }
        EXPECT_NEAR(sum * double(kernel_peak(radius * radius)), 1, 1e-4);
    }
}

TEST(Kernel, IsOneAtItsCentreAndNothingAtItsRim) {
    EXPECT_EQ(kernel_shape(0), 1);
    EXPECT_NEAR(kernel_shape(1), 0, 1e-6f);
    for (float part = 0; part < 2; part += 0.01f) {
        EXPECT_EQ(kernel_weight(part), part < 1 ? kernel_shape(part) : 0.0f) << part;
        EXPECT_GE(kernel_weight(part), kernel_weight(part + 0.01f)) << part;
    }
}

TEST(Kernel, OverATriangleAddsUpStripByStrip) {
    constexpr double r = 0.7, p = 0.3;
    for (const double t : {0.1, 0.4, -0.6}) {
        constexpr int steps = 1000;
        double sum = 0;  // strips along the edge, of the triangle that narrows to the centre
        for (int i = 0; i < steps; ++i)
            for (int k = 0; k < steps; ++k) {
                const double x = p * (i + 0.5) / steps, y = t * x / p * (k + 0.5) / steps;
                sum += double(kernel_shape(float((x * x + y * y) / (r * r)))) * (p / steps) * (t * x / p / steps);
            }
        EXPECT_NEAR(double(kernel_shape_over_triangle(float(p), float(t), float(r * r))), sum, 1e-6) << t;
    }
}

}  // namespace
}  // namespace lw
