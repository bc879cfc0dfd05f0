// The analytic cases of CIE 171:2006 ("Test cases to assess the accuracy of lighting computer programs") that a scene
// without a sky can hold, each with its formula, and some that the standard's users add (cylindrical illuminance, sun).
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace lw {

struct CieResult {
    std::string section;  // of CIE 171:2006, or "-"
    std::string what;
    std::string formula;
    double expected = 0, measured = 0;  // lx, or lm where `what` says so
    double half_width = 0;              // of the 90 % interval of the measured value
    std::optional<double> published;    // what public copies of the standard print for the same point
    /// Relative; in the unit of the case where nothing is expected.
    double error() const { return expected > 0 ? measured / expected - 1 : measured; }
};

/// Runs all cases by the functions behind lumenwalk-measure; `photons` per bake.
std::vector<CieResult> run_cie171(unsigned long photons);

}  // namespace lw
