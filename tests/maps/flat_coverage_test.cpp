// The coverage of kernels in closed form: against what geometry says, and against integrals by numbers.
#include "maps/flat_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace lw {
namespace {

using Polygon = std::vector<vec2>;

const CoverageLevels radii{0.25f, 0.5f, 0.75f, 1};

Polygon rectangle(vec2 low, vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

Polygon turned(Polygon polygon, float angle) {
    for (vec2& p : polygon)
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
    return polygon;
}

void expect_all(const CoverageLevels& got, float expected, float tolerance = 2e-6f) {
    for (float level : got) EXPECT_NEAR(level, expected, tolerance);
}

TEST(KernelIntegrals, AreOneWhereThePolygonCoversTheLargestKernel) {
    expect_all(integrate_kernels(rectangle({-1, -1}, {1, 1}), radii), 1);
    expect_all(integrate_kernels(rectangle({-3, -5}, {1.5f, 1.25f}), radii), 1);
    expect_all(integrate_kernels({{-4, -2}, {4, -2}, {0, 6}}, radii), 1);
}

TEST(KernelIntegrals, AreNothingOfAPolygonBeyondThem) {
    expect_all(integrate_kernels(rectangle({1, -1}, {3, 1}), radii), 0);
    expect_all(integrate_kernels({}, radii), 0);
}

TEST(KernelIntegrals, AreHalfAtAnEdgeAndAQuarterInACorner) {
    for (float angle : {0.0f, 0.3f, 2.0f, 4.5f}) {
        expect_all(integrate_kernels(turned(rectangle({-5, 0}, {5, 5}), angle), radii), 0.5f);
        expect_all(integrate_kernels(turned(rectangle({0, 0}, {5, 5}), angle), radii), 0.25f);
        expect_all(integrate_kernels(turned({{0, 0}, {5, 0}, {2.5f, 2.5f * std::sqrt(3.0f)}}, angle), radii), 1.0f / 6);
    }
}

/// The part of a kernel of radius 1 on one side of a line at distance t, from its density across the line,
/// 8 / (3 pi) (1 - t^2)^(3/2).
double part_beyond(double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 0.5 - (t * (5 - 2 * t * t) * std::sqrt(1 - t * t) / 3 + std::asin(t)) / M_PI;
}

TEST(KernelIntegrals, FallWithTheDistanceOfAnEdgeAsTheKernelDoes) {
    for (float distance = -1.1f; distance <= 1.1f; distance += 0.05f) {
        const CoverageLevels got = integrate_kernels(turned(rectangle({-5, distance}, {5, 6}), 1), radii);
        for (size_t level = 0; level < radii.size(); ++level)
            EXPECT_NEAR(got[level], part_beyond(double(distance) / double(radii[level])), 3e-6) << distance;
    }
}

TEST(KernelIntegrals, OfAPolygonInsideTheKernelAreItsAreaAndItsSecondMoment) {
    const double side = 0.2;  // of a square around the origin: its moments are side^2 and side^4 / 6
    const float half = float(0.5 * side);
    const CoverageLevels got = integrate_kernels(turned(rectangle(vec2(-half), vec2(half)), 0.4f), radii);
    for (size_t level = 0; level < radii.size(); ++level) {
        const double r2 = std::pow(double(radii[level]), 2);
        EXPECT_NEAR(got[level], 2 / (M_PI * r2) * (side * side - std::pow(side, 4) / 6 / r2), 2e-6);
    }
}

/// A polygon with its corners on an ellipse that may hold the origin, touch it or lie beside it.
Polygon random_polygon(Rng& rng) {
    const vec2 centre(3 * rng.next() - 1.5f, 3 * rng.next() - 1.5f), half(0.1f + 2 * rng.next(), 0.1f + rng.next());
    std::vector<float> angles(3 + size_t(6 * rng.next()));
    for (float& angle : angles) angle = 2 * lw_pi * rng.next();
    std::sort(angles.begin(), angles.end());
    Polygon polygon;
    for (float angle : angles) polygon.push_back(centre + half * vec2(std::cos(angle), std::sin(angle)));
    return turned(polygon, 7 * rng.next());
}

/// By rays from the origin: along each, the kernel of radius r between the sides of a convex polygon.
double integral_by_rays(const Polygon& polygon, double r) {
    constexpr int rays = 20'000;
    double sum = 0;
    for (int k = 0; k < rays; ++k) {
        const double angle = 2 * M_PI * (k + 0.5) / rays;
        const glm::dvec2 ray(std::cos(angle), std::sin(angle));
        double first = 0, last = r;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 a(polygon[i]), edge = glm::dvec2(polygon[(i + 1) % polygon.size()]) - a;
            const glm::dvec2 inwards(-edge.y, edge.x);
            const double speed = glm::dot(ray, inwards), distance = glm::dot(-a, inwards);  // at 0; inside: positive
            if (speed > 0) first = std::max(first, -distance / speed);
            if (speed < 0) last = std::min(last, -distance / speed);
            if (speed == 0 && distance < 0) last = 0;
        }
        const auto below = [r](double t) { return t * t - t * t * t * t / (2 * r * r); };
        if (first < last) sum += 2 / (rays * r * r) * (below(last) - below(first));
    }
    return sum;
}

TEST(KernelIntegrals, AreThoseByNumbersForAnyConvexPolygon) {
    Rng rng(1, 1, 1);
    int cut = 0;
    for (int i = 0; i < 200; ++i) {
        const Polygon polygon = random_polygon(rng);
        const CoverageLevels got = integrate_kernels(polygon, radii);
        for (size_t level = 0; level < radii.size(); ++level) {
            const double expected = integral_by_rays(polygon, double(radii[level]));
            ASSERT_NEAR(got[level], expected, 2e-4) << "polygon " << i << ", radius " << radii[level];
            cut += expected > 0.01 && expected < 0.99;
        }
    }
    EXPECT_GT(cut, 100);
}

TEST(KernelIntegrals, OfTwoPartsAreThatOfTheWhole) {
    Rng rng(1, 1, 2);
    for (int i = 0; i < 1000; ++i) {
        const Polygon whole = random_polygon(rng);
        const size_t corner = 2 + size_t(rng.next() * float(whole.size() - 2));
        if (corner + 1 >= whole.size()) continue;
        const Polygon one(whole.begin(), whole.begin() + int64_t(corner) + 1);
        Polygon other(whole.begin() + int64_t(corner), whole.end());
        other.push_back(whole[0]);
        const CoverageLevels a = integrate_kernels(one, radii), b = integrate_kernels(other, radii),
                             all = integrate_kernels(whole, radii);
        for (size_t level = 0; level < radii.size(); ++level) ASSERT_NEAR(a[level] + b[level], all[level], 1e-5) << i;
    }
}

}  // namespace
}  // namespace lw
