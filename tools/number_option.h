// Checks of command line values that CLI11 lets through: its Range takes "nan" for a number within any range.
#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace lw {

/// Accepts a finite number from `least` to `most`.
inline CLI::Validator finite_number(double least, double most) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", least, most);
    const std::string expected = range;
    return CLI::Validator(
        [=](std::string& text) {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool whole = !text.empty() && *end == '\0' && std::isfinite(value);
            return whole && value >= least && value <= most ? "" : "give a number from " + expected;
        },
        expected, "FINITE_NUMBER");
}

}  // namespace lw
