// Pieces of an HTML page: escaped text, pictures inside the page, drawings of grids.
#pragma once
#include <cstdio>
#include <string>
#include <vector>

#include "image/rgb8_image.h"
#include "measure/survey.h"
#include "trace/ray_caster.h"

namespace lw {

/// The text with & < > " replaced by HTML entities.
std::string escaped(const std::string& text);

/// Formats as printf does, into a string of at most 511 bytes.
template <class... Values>
std::string printed(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// The picture as a data: URL of a PNG.
std::string data_address(const Rgb8Image& image);

/// A bar of the false colours from `low` to `high` lx with levels written under it, as HTML.
std::string legend(double low, double high);

/// A grid as SVG: its `plan`, which reaches `band` m beyond the grid, over it the values in false colours from `low` to
/// `high` lx, isolux lines, and the numbers when the grid is small. `values`: one per sensor of the grid.
std::string grid_drawing(const MeasuredSet& measured, const std::vector<Value>& values, const Rgb8Image& plan,
                         float band, double low, double high);

}  // namespace lw
