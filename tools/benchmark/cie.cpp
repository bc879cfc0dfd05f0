// CIE 171:2006: measured beside the formula, case by case.
#include <cstdio>

#include "cie171.h"
#include "sections.h"

namespace lw {
namespace {

std::string published_text(const CieResult& result) {
    if (!result.published) return "";
    char text[32];
    std::snprintf(text, sizeof text, "%g", *result.published);
    return text;
}

}  // namespace

std::vector<Table> measure_cie171(const Bench& bench) {
    const uint64_t photons = bench.pick<uint64_t>(100'000, 400'000);
    Table table{
        "cie171", "cases", "Analytic cases of CIE 171:2006, " + std::to_string(photons) + " photons a case", {}};
    for (const CieResult& result : run_cie171(photons)) {
        char error[32];
        std::snprintf(error, sizeof error, "%+.2f", 100 * result.error());
        table.rows.push_back({{"CIE 171", result.section},
                              {"case", result.what},
                              {"formula", result.formula},
                              {"published", published_text(result)},
                              {"expected", result.expected},
                              {"measured", result.measured},
                              {"+- (90 %)", result.half_width},
                              {"error %", error}});
    }
    return {table};
}

}  // namespace lw
