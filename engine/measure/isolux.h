// Lines of equal illuminance of a grid, and the false colours of a value: shared by plans and pictures.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "image/rgb8_image.h"
#include "shaders/types.h"

namespace lw {

/// A straight piece of an isolux line, in cells of the grid: sensor (column, row) lies at (column + 0.5, row + 0.5).
struct IsoluxSegment {
    vec2 from, to;
};

/// The line at `level`, by marching squares with linear interpolation between neighbouring sensors. `values`: columns x
/// rows, row by row. Ambiguous squares are decided by the mean of their corners.
std::vector<IsoluxSegment> isolux_line(std::span<const double> values, uint columns, uint rows, double level);

/// At most nine levels between two illuminances, from the series 1, 2, 3, 5, 7.5 x 10^n lux.
std::vector<double> isolux_levels(double low, double high);

/// The colour of a value from 0 (dark blue) to 1 (dark red), as sRGB codes: the map "turbo" (Mikhailov 2019).
std::array<uint8_t, 3> false_color(double share);

/// Where `value` lies between `low` (0) and `high` (1) on a logarithmic scale; clamped to [0, 1].
double log_share(double value, double low, double high);

}  // namespace lw
