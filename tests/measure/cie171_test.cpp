// Analytic cases of CIE 171:2006: every measured value within 2 % of its formula.
#include <gtest/gtest.h>

#include "benchmark/cie171.h"

namespace lw {
namespace {

TEST(Cie171, EveryCaseIsWithinTwoPercentOfItsFormula) {
    const std::vector<CieResult> results = run_cie171(100'000);
    EXPECT_GE(results.size(), 40u);
    for (const CieResult& result : results)
        EXPECT_NEAR(result.measured / result.expected, 1, 0.02)
            << result.section << " " << result.what << ": " << result.measured << " +- " << result.half_width << " for "
            << result.expected << " (" << result.formula << ")";
}

}  // namespace
}  // namespace lw
