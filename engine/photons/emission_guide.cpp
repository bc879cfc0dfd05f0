#include "photons/emission_guide.h"

#include <algorithm>

namespace lw {
namespace {

/// Averages each cell of the side x side values with its neighbours.
std::vector<double> blurred(const std::vector<double>& values) {
    constexpr int side = EmissionGuide::side;
    std::vector<double> result(values.size(), 0);
    for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c)
            for (int dr = -1; dr <= 1; ++dr)
                for (int dc = -1; dc <= 1; ++dc) {
                    const int row = std::clamp(r + dr, 0, side - 1), column = (c + dc + side) % side;
                    result[size_t(r * side + c)] += values[size_t(row * side + column)] / 9;
                }
    return result;
}

/// Picks an entry of a cumulative table of `side` entries that ends at 1, by `u` in [0, 1). Sets `within`, where in the
/// entry `u` lies from 0 to 1, and the entry's probability.
int pick(const float* cumulative, float u, float& within, float& probability) {
    const float* chosen = std::min(std::upper_bound(cumulative, cumulative + EmissionGuide::side, u),
                                   cumulative + EmissionGuide::side - 1);
    const float below = chosen == cumulative ? 0.0f : *(chosen - 1);
    probability = *chosen - below;
    constexpr float last = 1 - 4e-6f;  // rounds to no next entry in a sum with side - 1
    within = std::clamp((u - below) / std::max(probability, 1e-20f), 0.0f, last);
    return int(chosen - cumulative);
}

}  // namespace

EmissionGuide::EmissionGuide(const std::vector<double>& usefulness) : rows_(side), cells_(side * side) {
    std::vector<double> density = blurred(usefulness);
    double mean = 0;
    for (double d : density) mean += d / double(density.size());
    for (double& d : density) d += mean > 0 ? 0.03 * mean : 1.0;
    double total = 0, below = 0;
    for (double d : density) total += d;
    for (size_t r = 0; r < side; ++r) {
        double row = 0, sum = 0;
        for (size_t c = 0; c < side; ++c) row += density[r * side + c];
        for (size_t c = 0; c < side; ++c) cells_[r * side + c] = float((sum += density[r * side + c]) / row);
        rows_[r] = float((below += row) / total);
        cells_[r * side + side - 1] = 1;
    }
    rows_[side - 1] = 1;
}

float EmissionGuide::warp(std::array<float, 5>& u) const {
    if (rows_.empty()) return 1;
    float in_row = 0, in_cell = 0, p_row = 0, p_cell = 0;
    const int row = pick(rows_.data(), u[0], in_row, p_row);
    const int cell = pick(cells_.data() + row * side, u[1], in_cell, p_cell);
    u[0] = (float(row) + in_row) / side;
    u[1] = (float(cell) + in_cell) / side;
    return 1 / (p_row * side * p_cell * side);
}

}  // namespace lw
