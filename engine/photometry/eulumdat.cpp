#include <algorithm>
#include <cmath>
#include <functional>

#include "photometry/intensities.h"
#include "photometry/lamp_color.h"
#include "photometry/number_reader.h"
#include "photometry/photometry.h"

namespace lw {
namespace {

/// The C planes in degrees whose intensities the file gives, of `all` planes of the full circle. `symmetry` is Isym of
/// the format: 0 none, 1 about the vertical axis, 2 about the plane C0-C180, 3 about C90-C270, 4 about both. Fails
/// through the reader when the planes do not fit it.
std::vector<double> given_planes(const std::vector<double>& all, size_t symmetry, NumberReader& reader) {
    const size_t count = all.size();
    if (symmetry == 1) return {0};
    const size_t parts = symmetry == 0 ? 1 : symmetry == 4 ? 4 : 2;
    if (count % parts != 0 || (symmetry == 3 && count % 4 != 0))
        reader.fail("the number of planes does not fit the symmetry");
    std::vector<double> planes;
    if (symmetry == 3) {
        for (size_t i = 3 * count / 4; i < count; ++i) planes.push_back(all[i] - 360);
        for (size_t i = 0; i <= count / 4; ++i) planes.push_back(all[i]);
    } else {
        const size_t given = symmetry == 0 ? count : count / parts + 1;
        planes.assign(all.begin(), all.begin() + ptrdiff_t(std::min(given, count)));
    }
    const double first = symmetry == 3 ? -90 : 0, last = symmetry == 2 ? 180 : symmetry == 0 ? planes.back() : 90;
    if (planes.front() != first || planes.back() != last) reader.fail("the planes do not fit the symmetry");
    return planes;
}

bool rises(const std::vector<double>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

/// A number on a line of its own, with the comma that some writers use.
double number_on_line(NumberReader& reader, const std::string& what) {
    std::string line = reader.line(what);
    std::replace(line.begin(), line.end(), ',', '.');
    try {
        return NumberReader(line, "").number(what);
    } catch (const std::exception&) {
        reader.fail(what + ": \"" + line.substr(0, 20) + "\" is not a number (on the line before)");
    }
}

size_t count_on_line(NumberReader& reader, const std::string& what, size_t least, size_t most) {
    const double value = number_on_line(reader, what);
    if (value < double(least) || value > double(most) || value != std::floor(value))
        reader.fail(what + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return size_t(value);
}

}  // namespace

Photometry parse_eulumdat(const std::string& text, const std::string& name) {
    NumberReader reader(text, name);
    Photometry photometry;
    reader.line("the company");
    reader.line("the type");
    const size_t symmetry = count_on_line(reader, "the symmetry (line 3)", 0, 4);
    const size_t planes = count_on_line(reader, "the number of C planes (line 4)", 1, 721);
    reader.line("the distance of planes");
    const size_t verticals = count_on_line(reader, "the number of intensities (line 6)", 2, 361);
    reader.line("the distance of angles");
    for (const char* what : {"the report", "the name"}) photometry.name = reader.line(what);
    for (int i = 0; i < 3; ++i) reader.line("number, file and date");
    for (int i = 0; i < 9; ++i) reader.line("the sizes");
    reader.line("the downward flux fraction");
    const double output_percent = number_on_line(reader, "the light output ratio (line 23)");
    const double conversion = number_on_line(reader, "the conversion factor (line 24)");
    reader.line("the tilt");
    const size_t sets = count_on_line(reader, "the number of lamp sets (line 26)", 1, 20);
    double lumens = 0;
    bool absolute = false;
    for (size_t set = 0; set < sets; ++set) {
        const double lamps = number_on_line(reader, "the number of lamps");
        reader.line("the type of lamps");
        const double flux = number_on_line(reader, "the flux of the lamps");
        const std::string color = reader.line("the colour");
        reader.line("the colour rendering");
        reader.line("the watts");
        if (set > 0) continue;  // the sets are alternatives
        absolute = lamps < 0;
        lumens = flux;
        photometry.color_temperature = temperature_of(color);
    }
    if (!(lumens > 0)) reader.fail("the flux of the lamps must be positive");
    for (int i = 0; i < 10; ++i) reader.line("the direct ratios");
    std::vector<double> all;
    for (size_t i = 0; i < planes; ++i) all.push_back(number_on_line(reader, "a C angle"));
    for (size_t i = 0; i < verticals; ++i) photometry.vertical.push_back(number_on_line(reader, "a G angle"));
    if (!rises(all) || !rises(photometry.vertical)) reader.fail("the angles must rise");
    if (all.front() < 0 || all.back() > 360) reader.fail("the C planes lie outside 0 to 360");
    if (photometry.vertical.front() < 0 || photometry.vertical.back() > 180)
        reader.fail("the G angles lie outside 0 to 180");
    photometry.horizontal = given_planes(all, symmetry, reader);
    for (size_t i = 0; i < photometry.horizontal.size() * verticals; ++i)
        photometry.candela.push_back(number_on_line(reader, "an intensity"));
    note_left_over(reader, photometry);
    settle_negative_intensities(reader, photometry);
    note_missing_angles(reader, photometry);
    for (double& value : photometry.candela) value = value * (conversion > 0 ? conversion : 1) * lumens / 1000;
    if (symmetry == 0 && planes > 1 && all.back() < 360) close_ring(photometry);
    photometry.lamp_lumens = absolute ? 0 : lumens;
    photometry.stated_output = output_percent > 0 ? lumens * output_percent / 100 : 0;
    return photometry;
}

}  // namespace lw
