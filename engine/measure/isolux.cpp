#include "measure/isolux.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lw {
namespace {

/// Where the line crosses the edge between two neighbouring sensors, if it does.
struct Crossing {
    bool exists;
    vec2 at;
};

Crossing cross_edge(vec2 a, double value_a, vec2 b, double value_b, double level) {
    if ((value_a >= level) == (value_b >= level)) return {false, a};
    return {true, mix(a, b, float((level - value_a) / (value_b - value_a)))};
}

/// The pieces of the line within the square of four sensors.
void cut_square(const std::array<vec2, 4>& corners, const std::array<double, 4>& values, double level,
                std::vector<IsoluxSegment>& line) {
    std::array<vec2, 4> at;
    std::array<size_t, 4> edges;
    size_t count = 0;
    for (size_t e = 0; e < 4; ++e) {
        const size_t next = (e + 1) % 4;
        const Crossing c = cross_edge(corners[e], values[e], corners[next], values[next], level);
        if (c.exists) edges[count] = e, at[count++] = c.at;
    }
    if (count == 2) line.push_back({at[0], at[1]});
    if (count < 4) return;
    const bool high_middle = (values[0] + values[1] + values[2] + values[3]) / 4 >= level;
    const bool cut_first = high_middle == (values[0] >= level);  // corners 1 and 3 are cut off, or 0 and 2
    if (cut_first) {
        line.push_back({at[0], at[1]});
        line.push_back({at[2], at[3]});
    } else {
        line.push_back({at[3], at[0]});
        line.push_back({at[1], at[2]});
    }
}

}  // namespace

std::vector<IsoluxSegment> isolux_line(std::span<const double> values, uint columns, uint rows, double level) {
    std::vector<IsoluxSegment> line;
    for (uint y = 0; y + 1 < rows; ++y)
        for (uint x = 0; x + 1 < columns; ++x) {
            const vec2 low(float(x) + 0.5f, float(y) + 0.5f);
            const size_t first = size_t(y) * columns + x;
            cut_square({low, low + vec2(1, 0), low + vec2(1, 1), low + vec2(0, 1)},
                       {values[first], values[first + 1], values[first + columns + 1], values[first + columns]}, level,
                       line);
        }
    return line;
}

std::vector<double> isolux_levels(double low, double high) {
    std::vector<double> levels;
    if (!(high > 0)) return levels;
    low = std::max(low, high * 1e-3);
    for (int power = int(std::floor(std::log10(low))); power <= int(std::floor(std::log10(high))); ++power)
        for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.5, 9.0}) {
            const double level = step * std::pow(10.0, power);
            if (level > low && level < high) levels.push_back(level);
        }
    while (levels.size() > 9) {
        std::vector<double> fewer;
        for (size_t i = 1; i < levels.size(); i += 2) fewer.push_back(levels[i]);
        levels = fewer;
    }
    return levels;
}

std::array<uint8_t, 3> false_color(double share) {
    const double x = std::clamp(share, 0.0, 1.0);
    constexpr std::array<std::array<double, 6>, 3> coefficients{
        {{0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943},
         {0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604},
         {0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973}}};
    std::array<uint8_t, 3> rgb{};
    for (size_t c = 0; c < 3; ++c) {
        double value = 0;
        for (size_t i = 6; i-- > 0;) value = value * x + coefficients[c][i];
        rgb[c] = uint8_t(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
    }
    return rgb;
}

double log_share(double value, double low, double high) {
    if (!(value > low) || !(high > low) || !(low > 0)) return value > low ? 1 : 0;
    return std::min(std::log(value / low) / std::log(high / low), 1.0);
}

}  // namespace lw
