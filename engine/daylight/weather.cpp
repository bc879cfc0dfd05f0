#include "daylight/weather.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/one_line.h"
#include "photometry/plain_text.h"

namespace lw {
namespace {

constexpr double most_irradiance = 2000;  // W/m2, more than the sun outside the air
constexpr size_t most_hours = 366 * 24;

/// The lines of a file, one after the other.
class Lines {
  public:
    Lines(const std::string& bytes, std::string name) : text_(plain_text(bytes)), name_(std::move(name)) {}

    bool at_end() const { return text_.find_first_not_of(" \t\n", at_) == std::string::npos; }
    /// The next line; `what` is expected there.
    std::string next(const std::string& what) {
        ++number_;
        if (at_ >= text_.size()) fail("the file ends before " + what);
        const size_t end = std::min(text_.find('\n', at_), text_.size());
        const std::string line = text_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }
    /// Throws Error about the line that was read last.
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(one_line(name_ + ": line " + std::to_string(number_) + ": " + what));
    }

  private:
    std::string text_, name_;
    size_t at_ = 0, number_ = 0;
};

/// The fields of one line of a file.
class Fields {
  public:
    /// Splits at each comma, or, with ' ', at blanks and tabs.
    Fields(Lines& lines, char separator, const std::string& what) : lines_(lines) {
        const std::string line = lines.next(what), separators = separator == ' ' ? " \t" : std::string(1, separator);
        for (size_t at = 0; at <= line.size();) {
            const size_t end = std::min(line.find_first_of(separators, at), line.size());
            if (separator != ' ' || end > at) fields_.push_back(line.substr(at, end - at));
            at = end + 1;
        }
        is_blank_ = line.find_first_not_of(" \t") == std::string::npos;
    }
    bool is_blank() const { return is_blank_; }
    const std::string& text(size_t i, const std::string& what) const {
        if (i >= fields_.size()) lines_.fail(what + " is missing");
        return fields_[i];
    }
    double number(size_t i, const std::string& what, double least, double most) const {
        const std::string& word = text(i, what);
        const size_t from = word.find_first_not_of(" \t+"), to = word.find_last_not_of(" \t");
        const char* first = word.data() + (from == std::string::npos ? 0 : from);
        const char* last = word.data() + (to == std::string::npos ? 0 : to + 1);
        double value = 0;
        const std::from_chars_result result = std::from_chars(first, last, value);
        if (result.ec != std::errc() || result.ptr != last || !std::isfinite(value))
            lines_.fail(what + ": \"" + word.substr(0, 20) + "\" is not a number");
        if (value < least || value > most) {
            char range[80];
            std::snprintf(range, sizeof range, " must be from %.9g to %.9g", least, most);
            lines_.fail(what + range);
        }
        return value;
    }
    int whole(size_t i, const std::string& what, int least, int most) const {
        const double value = number(i, what, least, most);
        if (value != std::floor(value)) lines_.fail(what + " must be a whole number");
        return int(value);
    }
    /// A measurement in W/m2; files write 9999 for one that is missing.
    double irradiance(size_t i, const std::string& what) const {
        const double value = number(i, what, -9999, 9999);
        if (value == 9999 || value < 0) lines_.fail(what + " was not measured");
        if (value > most_irradiance) lines_.fail(what + " is larger than 2000 W/m2");
        return value;
    }
    void set_day(WeatherHour& hour, size_t month, size_t day) const {
        hour.month = whole(month, "the month", 1, 12);
        hour.day = whole(day, "the day", 1, 31);
        constexpr std::chrono::year leap(2024);
        if (!std::chrono::year_month_day(leap, std::chrono::month(unsigned(hour.month)),
                                         std::chrono::day(unsigned(hour.day)))
                 .ok())
            lines_.fail("there is no such day");
    }

  private:
    Lines& lines_;
    std::vector<std::string> fields_;
    bool is_blank_;
};

void add_hour(Lines& lines, const WeatherHour& hour, Weather& weather) {
    if (weather.hours.size() == most_hours) lines.fail("the file has more than the hours of a year");
    weather.hours.push_back(hour);
}

/// A line of the header of an EPW file, which begins with `name`.
Fields epw_header(Lines& lines, const std::string& name) {
    const Fields fields(lines, ',', "the line " + name);
    if (upper_case(fields.text(0, name)) != name) lines.fail("this line must begin with " + name);
    return fields;
}

/// EnergyPlus Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary".
Weather read_epw(Lines& lines) {
    Weather weather;
    const Fields location = epw_header(lines, "LOCATION");
    weather.place.latitude = location.number(6, "the latitude", -90, 90);
    weather.place.longitude = location.number(7, "the longitude", -180, 180);
    weather.offset = int(std::lround(60 * location.number(8, "the time zone", -12, 14)));
    for (const char* name : {"DESIGN CONDITIONS", "TYPICAL/EXTREME PERIODS", "GROUND TEMPERATURES",
                             "HOLIDAYS/DAYLIGHT SAVINGS", "COMMENTS 1", "COMMENTS 2"})
        epw_header(lines, name);
    if (epw_header(lines, "DATA PERIODS").number(2, "the number of records an hour", 1, 60) != 1)
        lines.fail("only files with one record an hour are read");
    while (!lines.at_end()) {
        const Fields fields(lines, ',', "an hour");
        if (fields.is_blank()) continue;
        WeatherHour hour;
        fields.set_day(hour, 1, 2);
        hour.middle = fields.whole(3, "the hour", 1, 24) - 0.5;  // the field names the end of the hour
        const double dew_point = fields.number(7, "the dew point", -100, 100);
        if (dew_point < 99) hour.dew_point = dew_point;  // 99.9: not measured
        hour.direct_normal = fields.irradiance(14, "the direct normal irradiance");
        hour.diffuse_horizontal = fields.irradiance(15, "the diffuse horizontal irradiance");
        add_hour(lines, hour, weather);
    }
    return weather;
}

/// The value of a line "NAME VALUE" of the header of a .wea file.
double wea_header(Lines& lines, const std::string& name, double most) {
    const Fields fields(lines, ' ', "the line " + name);
    if (fields.text(0, name) != name) lines.fail("this line must begin with " + name);
    return fields.number(1, name, -most, most);
}

/// The format of gendaymtx of Radiance (its manual page). Longitude and time zone are positive in the west; an hour
/// is named by its middle.
Weather read_wea(Lines& lines) {
    Weather weather;
    if (!lines.next("the line place").starts_with("place")) lines.fail("this line must begin with place");
    weather.place.latitude = wea_header(lines, "latitude", 90);
    weather.place.longitude = -wea_header(lines, "longitude", 180);
    weather.offset = -int(std::lround(4 * wea_header(lines, "time_zone", 210)));  // 15 degrees an hour
    wea_header(lines, "site_elevation", 1e4);
    if (wea_header(lines, "weather_data_file_units", 10) != 1)
        lines.fail("only units 1 are read: direct normal and diffuse horizontal irradiance");
    while (!lines.at_end()) {
        const Fields fields(lines, ' ', "an hour");
        if (fields.is_blank()) continue;
        WeatherHour hour;
        fields.set_day(hour, 0, 1);
        hour.middle = fields.number(2, "the hour", 0, 24);
        hour.direct_normal = fields.irradiance(3, "the direct normal irradiance");
        hour.diffuse_horizontal = fields.irradiance(4, "the diffuse horizontal irradiance");
        add_hour(lines, hour, weather);
    }
    return weather;
}

}  // namespace

Weather parse_weather(const std::string& bytes, const std::string& name) {
    const std::string kind = upper_case(std::filesystem::path(name).extension().string());
    if (kind != ".EPW" && kind != ".WEA") throw Error(one_line(name) + ": weather files end in .epw or .wea");
    Lines lines(bytes, name);
    Weather weather = kind == ".EPW" ? read_epw(lines) : read_wea(lines);
    if (weather.hours.empty()) lines.fail("the file has no hours");
    weather.file = name;
    return weather;
}

Weather load_weather(const std::filesystem::path& path) { return parse_weather(read_text_file(path), path.string()); }

const WeatherHour& hour_at(const Weather& weather, const Moment& moment) {
    const ClockTime time = clock_time(moment, weather.offset);
    for (const WeatherHour& hour : weather.hours)
        if (hour.month == time.month && hour.day == time.day && std::abs(time.hour - hour.middle) <= 0.5 &&
            time.hour != hour.middle + 0.5)
            return hour;
    char text[64];
    std::snprintf(text, sizeof text, ": has no hour for %02d-%02d, %.2f h", time.month, time.day, time.hour);
    throw Error(one_line(weather.file + text));
}

Moment middle_of(const Weather& weather, const WeatherHour& hour, int year) {
    return moment_of({year, hour.month, hour.day, hour.middle}, weather.offset);
}

}  // namespace lw
