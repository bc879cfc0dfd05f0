#include <algorithm>
#include <cmath>

#include "photometry/number_reader.h"
#include "photometry/photometry.h"

namespace lw {
namespace {

bool starts_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

/// Whether the third factor of the file is one: LM-63-1995 and before call it ballast-lamp photometric factor.
bool has_lamp_factor(const std::string& first_line) {
    return !starts_with(first_line, "IESNA:LM-63-2002") && !starts_with(first_line, "IES:LM-63-2019");
}

void read_tilt(const std::string& line, NumberReader& reader, Photometry& photometry) {
    const std::string tilt = line.substr(5);
    if (tilt == "NONE") return;
    if (tilt != "INCLUDE") reader.fail("TILT=" + tilt + ": a tilt in another file is not read; write TILT=INCLUDE");
    reader.count("the lamp's position", 1, 3);
    const size_t count = reader.count("the number of tilt angles", 1, 1000);
    photometry.tilt_angles = reader.numbers("the tilt angles", count, true);
    photometry.tilt_factors = reader.numbers("the tilt factors", count);
}

void check_angles(const Photometry& p, NumberReader& reader) {
    const double low = p.vertical.front(), high = p.vertical.back(), first = p.horizontal.front(),
                 last = p.horizontal.back();
    if (p.type == Photometry::Type::C) {
        if (!((low == 0 || low == 90) && (high == 90 || high == 180) && low < high))
            reader.fail("vertical angles of type C go from 0 or 90 to 90 or 180");
        const bool half = first == 90 && last == 270;
        if (!half && !(first == 0 && (last == 0 || last == 90 || last == 180 || last == 360)))
            reader.fail("horizontal angles of type C go from 0 to 0, 90, 180 or 360, or from 90 to 270");
    } else {
        if (!((low == -90 || low == 0) && high == 90))
            reader.fail("vertical angles of types A and B go from -90 or 0 to 90");
        if (!((first == -90 || first == 0) && (last == 90 || (first == 0 && last == 0))))
            reader.fail("horizontal angles of types A and B go from -90 or 0 to 90");
    }
}

}  // namespace

Photometry parse_lm63(const std::string& text, const std::string& name) {
    NumberReader reader(text, name);
    Photometry photometry;
    const std::string first_line = reader.line("the first line");
    std::string line = first_line;
    while (!starts_with(line, "TILT=")) {
        if (starts_with(line, "[LUMINAIRE]")) photometry.name = line.substr(11);
        line = reader.line("TILT=");
    }
    read_tilt(line, reader, photometry);
    const auto lamps = double(reader.count("the number of lamps", 1, 10000));
    const double lumens = reader.number("lumens per lamp"), multiplier = reader.number("the candela multiplier");
    const size_t verticals = reader.count("the number of vertical angles", 2, 2000);
    const size_t horizontals = reader.count("the number of horizontal angles", 1, 2000);
    const size_t type = reader.count("the photometric type", 1, 3);
    photometry.type = type == 1 ? Photometry::Type::C : type == 2 ? Photometry::Type::B : Photometry::Type::A;
    reader.count("the units", 1, 2);
    reader.numbers("the size of the luminous opening", 3);
    const double ballast = reader.number("the ballast factor"), lamp_factor = reader.number("the ballast-lamp factor");
    reader.number("the input watts");
    if (!(multiplier > 0) || !(ballast > 0)) reader.fail("multiplier and ballast factor must be positive");
    photometry.vertical = reader.numbers("the vertical angles", verticals, true);
    photometry.horizontal = reader.numbers("the horizontal angles", horizontals, true);
    check_angles(photometry, reader);
    photometry.candela = reader.numbers("the candela values", verticals * horizontals);
    const double factor = multiplier * ballast * (has_lamp_factor(first_line) && lamp_factor > 0 ? lamp_factor : 1.0);
    for (double& value : photometry.candela) {
        if (value < 0) reader.fail("a candela value is negative");
        value *= factor;
    }
    photometry.lamp_lumens = lumens > 0 ? lamps * lumens : 0;
    return photometry;
}

}  // namespace lw
