// Checks of command line values that CLI11 lets through: its Range takes "nan" for a number within any range.
#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
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

/// Accepts the digits of a whole number below 2^64; CLI11 wraps -1 and takes what is larger for 2^64 - 1.
inline CLI::Validator whole_number() {
    return CLI::Validator(
        [](std::string& text) {
            uint64_t value = 0;
            const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool whole = failure == std::errc() && stop == text.data() + text.size();
            return whole ? "" : "give a whole number from 0 to 18446744073709551615";
        },
        "WHOLE NUMBER", "WHOLE_NUMBER");
}

}  // namespace lw
