#include "measure/html.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/base64.h"
#include "image/png.h"
#include "measure/isolux.h"

namespace lw {
namespace {

constexpr size_t max_numbers = 600;
constexpr double drawing_width = 720;  // CSS pixels

/// The value at a place (x, y) of the grid, in cells: bilinear between the sensors, constant beyond the outermost.
double value_at(const std::vector<Value>& values, const GridShape& grid, double x, double y) {
    const double column = std::clamp(x - 0.5, 0.0, double(grid.columns - 1)),
                 row = std::clamp(y - 0.5, 0.0, double(grid.rows - 1));
    const auto c0 = size_t(column), r0 = size_t(row);
    const size_t c1 = std::min<size_t>(c0 + 1, grid.columns - 1), r1 = std::min<size_t>(r0 + 1, grid.rows - 1);
    const double fc = column - double(c0), fr = row - double(r0);
    const auto at = [&](size_t r, size_t c) { return values[r * grid.columns + c].lux; };
    return (at(r0, c0) * (1 - fc) + at(r0, c1) * fc) * (1 - fr) + (at(r1, c0) * (1 - fc) + at(r1, c1) * fc) * fr;
}

Rgb8Image colored_grid(const std::vector<Value>& values, const GridShape& grid, double low, double high) {
    const int per_cell = std::clamp(int(512 / std::max(grid.columns, grid.rows)), 1, 24);
    Rgb8Image image{int(grid.columns) * per_cell, int(grid.rows) * per_cell, {}};
    image.rgb.reserve(3 * image.pixel_count());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double lux = value_at(values, grid, (x + 0.5) / per_cell, (y + 0.5) / per_cell);
            for (const uint8_t code : false_color(log_share(lux, low, high))) image.rgb.push_back(code);
        }
    return image;
}

/// Where to write the level of an isolux line: its point farthest from the numbers, which stand in the middles of the
/// cells. Nothing when it would hide one everywhere.
std::optional<vec2> label_place(const std::vector<IsoluxSegment>& line) {
    constexpr float beside_number = 0.25f;  // cells
    const auto off = [](vec2 at) { return length(fract(at) - vec2(0.5f)); };
    vec2 best = line[0].from;
    for (const IsoluxSegment& s : line)
        for (const vec2 at : {s.from, 0.5f * (s.from + s.to)})
            if (off(at) > off(best)) best = at;
    if (off(best) < beside_number) return std::nullopt;
    return best;
}

/// The isolux lines as SVG paths. Their levels follow the range of these values; the range of the colours is common to
/// all ambiances.
std::string isolux_paths(const std::vector<Value>& values, const GridShape& grid, const vec2& cell) {
    std::vector<double> lux;
    for (const Value& value : values) lux.push_back(value.lux);
    const auto [low, high] = std::minmax_element(lux.begin(), lux.end());
    std::string text;
    for (const double level : isolux_levels(*low, *high)) {
        const std::vector<IsoluxSegment> line = isolux_line(lux, grid.columns, grid.rows, level);
        if (line.empty()) continue;
        text += "<path class=iso d=\"";
        for (const IsoluxSegment& s : line)
            text += printed("M%.4g %.4gL%.4g %.4g", double(s.from.x * cell.x), double(s.from.y * cell.y),
                            double(s.to.x * cell.x), double(s.to.y * cell.y));
        text += "\"/>\n";
        if (const auto at = label_place(line))
            text += printed("<text class=level x=%.4g y=%.4g>%g</text>\n", double(at->x * cell.x),
                            double(at->y * cell.y), level);
    }
    return text;
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return result;
}

std::string data_address(const Rgb8Image& image) { return "data:image/png;base64," + base64(encode_png(image)); }

std::string legend(double low, double high) {
    std::string text = "<div class=legend><span class=bar style=\"background:linear-gradient(to right";
    for (int i = 0; i <= 16; ++i) {
        const auto rgb = false_color(i / 16.0);
        text += printed(",rgb(%d,%d,%d)", int(rgb[0]), int(rgb[1]), int(rgb[2]));
    }
    text += ")\"></span>";
    constexpr double room_for_unit = 0.95;  // part of the bar that levels may use; "lx" is written behind
    for (const double level : isolux_levels(low, high))
        if (const double at = log_share(level, low, high); at < room_for_unit)
            text += printed("<span class=tick style=\"left:%.2f%%\">%g</span>", 100 * at, level);
    return text + "<span class=unit>lx</span></div>\n";
}

std::string grid_drawing(const MeasuredSet& measured, const std::vector<Value>& values, const Rgb8Image& plan,
                         float band, double low, double high) {
    const GridShape& grid = measured.set.grid;
    const vec2 cell(length(grid.across), length(grid.along));
    const double wide = double(cell.x) * grid.columns, tall = double(cell.y) * grid.rows, edge = double(band);
    const double unit = (wide + 2 * edge) / drawing_width;  // m per CSS pixel
    const double letter = std::min({double(cell.x) / 4, double(cell.y) / 2.6, 13 * unit});
    std::string text =
        printed("<svg class=plan viewBox=\"%.4g %.4g %.4g %.4g\" style=\"font-size:%.4gpx;stroke-width:%.4g\">\n",
                -edge, -edge, wide + 2 * edge, tall + 2 * edge, letter, 1.4 * unit);
    text += printed("<image x=%.4g y=%.4g width=%.4g height=%.4g preserveAspectRatio=none href=\"", -edge, -edge,
                    wide + 2 * edge, tall + 2 * edge) +
            data_address(plan) + "\"/>\n";
    text += printed("<image x=0 y=0 width=%.4g height=%.4g preserveAspectRatio=none opacity=0.72 href=\"", wide, tall) +
            data_address(colored_grid(values, grid, low, high)) + "\"/>\n";
    text += printed("<rect class=field width=%.4g height=%.4g />\n", wide, tall);
    if (values.size() <= max_numbers)
        for (size_t i = 0; i < values.size(); ++i) {
            const double x = (double(i % grid.columns) + 0.5) * double(cell.x),
                         y = (double(i / grid.columns) + 0.5) * double(cell.y);
            const char* kind = measured.readings[i].blocked ? "blocked"
                               : values[i].doubt.empty()    ? "number"
                                                            : "doubtful";
            text += printed("<text class=%s x=%.4g y=%.4g>%.*f</text>\n", kind, x, y, values[i].lux < 9.95 ? 1 : 0,
                            values[i].lux);
        }
    text += printed("<g style=\"font-size:%.4gpx\">", 11 * unit) + isolux_paths(values, grid, cell) + "</g></svg>\n";
    return text;
}

}  // namespace lw
