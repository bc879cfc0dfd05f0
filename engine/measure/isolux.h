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

/// The line of `level` by marching squares between neighbouring sensors, linear between them. Row by row values;
/// saddles are cut by the mean of their corners.
std::vector<IsoluxSegment> isolux_line(std::span<const double> values, uint columns, uint rows, double level);

/// Levels for lines and legends between two illuminances: of the series 1 2 3 5 7.5 x 10^n lux, at most nine.
std::vector<double> isolux_levels(double low, double high);

/// A value between 0 (dark blue) and 1 (dark red) as sRGB codes: the turbo map (Mikhailov 2019).
std::array<uint8_t, 3> false_color(double share);

/// Where a value lies between two others on a logarithmic scale, 0 to 1.
double log_share(double value, double low, double high);

}  // namespace lw
