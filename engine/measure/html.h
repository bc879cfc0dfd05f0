// Pieces of an HTML page: escaped text, pictures inside the page, drawings of grids.
#pragma once
#include <cstdio>
#include <string>
#include <vector>

#include "image/rgb8_image.h"
#include "measure/survey.h"
#include "trace/ray_caster.h"

namespace lw {

/// & < > " as entities.
std::string escaped(const std::string& text);

/// printf into a string.
template <class... Values>
std::string printed(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// A PNG as a data: address.
std::string data_address(const Rgb8Image& image);

/// Colours from low to high with the levels written under them.
std::string legend(double low, double high);

/// The plan under a grid with its values in false colours, isolux lines and, of small grids, the numbers, as SVG.
std::string grid_drawing(const MeasuredSet& measured, const std::vector<Value>& values, const Rgb8Image& plan,
                         float band, double low, double high);

}  // namespace lw
