#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "photometry/intensities.h"
#include "photometry/number_reader.h"
#include "photometry/photometry.h"
#include "photometry/plain_text.h"

namespace lw {
namespace {

/// Year of the edition that the first line names, however it is spelled ("IES: LM-63-2019", "IESNA91"); 0 without one.
int edition_of(const std::string& first_line) {
    std::string label;
    for (const char c : upper_case(first_line))
        if (std::isalnum(static_cast<unsigned char>(c))) label += c;
    const size_t standard = label.find("LM63");
    size_t at = standard != std::string::npos ? standard + 4 : label.starts_with("IESNA") ? 5 : label.size();
    int year = 0;
    for (const size_t end = at + 4; at < std::min(end, label.size()) && label[at] >= '0' && label[at] <= '9'; ++at)
        year = 10 * year + (label[at] - '0');
    return year == 0 || year > 99 ? year : year + (year < 50 ? 2000 : 1900);
}

/// What follows TILT= on a line that begins so, in any case and with any blanks; nothing for another line.
std::optional<std::string> tilt_of(const std::string& line) {
    if (!upper_case(line).starts_with("TILT")) return std::nullopt;
    const size_t equals = line.find_first_not_of(" \t", 4);
    if (equals == std::string::npos || line[equals] != '=') return std::nullopt;
    const size_t value = line.find_first_not_of(" \t", equals + 1);
    return value == std::string::npos ? "" : line.substr(value);
}

void read_tilt_table(NumberReader& reader, Photometry& photometry) {
    reader.count("the lamp's position", 1, 3);
    const size_t count = reader.count("the number of tilt angles", 1, 1000);
    photometry.tilt_angles = reader.numbers("the tilt angles", count, true);
    photometry.tilt_factors = reader.numbers("the tilt factors", count);
}

void read_tilt(const std::string& tilt, const std::filesystem::path& folder, NumberReader& reader,
               Photometry& photometry) {
    if (upper_case(tilt) == "NONE") return;
    if (upper_case(tilt) == "INCLUDE") return read_tilt_table(reader, photometry);
    if (!folder.empty()) photometry.tilt_file = file_in_folder(folder, tilt);
    if (photometry.tilt_file.empty())
        reader.fail("TILT=" + tilt.substr(0, 80) +
                    ": there is no such file beside this one (on the line before); TILT=INCLUDE needs none");
    NumberReader table(read_text_file(photometry.tilt_file),
                       reader.name() + ": " + photometry.tilt_file.filename().string());
    read_tilt_table(table, photometry);
}

/// Whether planes that are no standard part of the circle go around it, ending a step before their start.
bool is_open_ring(const std::vector<double>& planes) {
    const double gap = 360 - (planes.back() - planes.front());
    double widest = 0;
    for (size_t i = 1; i < planes.size(); ++i) widest = std::max(widest, planes[i] - planes[i - 1]);
    return planes.size() > 2 && gap > 0 && gap <= widest * 1.001;
}

void settle_planes_of_type_c(const NumberReader& reader, Photometry& p) {
    const double first = p.horizontal.front(), last = p.horizontal.back();
    const bool half = (first == 90 && last == 270) || (first == -90 && last == 90);
    const bool part = first == 0 && (last == 0 || last == 90 || last == 180);
    if (half || part || (first >= -360 && last - first == 360)) return;
    if (!(first >= -360 && last <= 360 && is_open_ring(p.horizontal)))
        reader.fail(
            "horizontal angles of type C go from 0 to 0, 90 or 180, from 90 to 270, from -90 to 90 or around the "
            "circle");
    close_ring(p);
}

void settle_angles(const NumberReader& reader, Photometry& p) {
    const double low = p.vertical.front(), high = p.vertical.back(), first = p.horizontal.front(),
                 last = p.horizontal.back();
    if (p.type == Photometry::Type::C) {
        if (low < 0 || high > 180) reader.fail("vertical angles of type C lie from 0 to 180");
        settle_planes_of_type_c(reader, p);
    } else {
        if (low < -90 || high > 90) reader.fail("vertical angles of types A and B lie from -90 to 90");
        if (first < -90 || last > 90) reader.fail("horizontal angles of types A and B lie from -90 to 90");
    }
    note_missing_angles(reader, p);
}

std::string header_up_to_tilt(NumberReader& reader, std::string& first_line, Photometry& photometry) {
    do first_line = reader.line("the first line");
    while (first_line.empty());
    std::string line = first_line;
    for (;; line = reader.line("TILT=")) {
        if (const std::optional<std::string> tilt = tilt_of(line)) return *tilt;
        if (upper_case(line).starts_with("[LUMINAIRE]")) photometry.name = line.substr(11);
    }
}

/// One reading, with commas as the reader takes them.
Photometry read_lm63(NumberReader& reader, const std::filesystem::path& folder) {
    Photometry photometry;
    std::string first_line;
    read_tilt(header_up_to_tilt(reader, first_line, photometry), folder, reader, photometry);
    const auto lamps = double(reader.count("the number of lamps", 0, 10000));
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
    photometry.candela = reader.numbers("the candela values", verticals * horizontals);
    settle_negative_intensities(reader, photometry);
    settle_angles(reader, photometry);
    // LM-63-1995 and before call it ballast-lamp photometric factor; later it is for future use or the kind of file.
    const bool has_lamp_factor = edition_of(first_line) < 2002 && lamp_factor > 0;
    for (double& value : photometry.candela) value *= multiplier * ballast * (has_lamp_factor ? lamp_factor : 1.0);
    photometry.lamp_lumens = lumens > 0 ? lamps * lumens : 0;
    return photometry;
}

/// Commas within numbers as decimal points, if the file has as many numbers as it should when they are read so.
std::optional<Photometry> read_with_decimal_commas(NumberReader& reader, const std::filesystem::path& folder) {
    try {
        reader.start_over_with_decimal_commas();
        Photometry photometry = read_lm63(reader, folder);
        if (!reader.left_over().empty()) return std::nullopt;
        note(reader, photometry, "its commas are read as decimal points");
        return photometry;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

Photometry parse_lm63(const std::string& text, const std::string& name, const std::filesystem::path& folder) {
    NumberReader reader(text, name);
    std::string wrong;
    try {
        Photometry photometry = read_lm63(reader, folder);
        const size_t notes = photometry.notes.size();
        note_left_over(reader, photometry);
        if (!reader.met_glued_commas() || photometry.notes.size() == notes) return photometry;
        wrong = photometry.notes.back();
    } catch (const Error& error) {
        if (!reader.met_glued_commas()) throw;
        wrong = error.what();
    }
    if (std::optional<Photometry> photometry = read_with_decimal_commas(reader, folder)) return *photometry;
    throw Error(wrong);
}

}  // namespace lw
