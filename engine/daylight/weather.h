// The hours of a year as weather files have them: EnergyPlus weather (.epw) and the tables of Radiance (.wea).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "daylight/moment.h"
#include "daylight/solar_position.h"

namespace lw {

/// What was measured in an hour. EPW names an hour by its end; the sun is taken at its middle.
struct WeatherHour {
    int month = 1, day = 1;
    double middle = 0;                                 // hours of local standard time, never of summer time
    double direct_normal = 0, diffuse_horizontal = 0;  // W/m2
    double dew_point = 10.97;                          // degrees Celsius; .wea files have none
};

struct Weather {
    std::string file;  // its path, for messages
    Place place;
    int offset = 0;  // minutes by which local standard time is ahead of universal time
    std::vector<WeatherHour> hours;
};

/// Reads a file by its extension. Throws Error("FILE: line N: what") for anything malformed or out of range, for
/// missing measurements, and for records shorter than an hour.
Weather load_weather(const std::filesystem::path& path);

/// The same from the bytes of a file; `name` ends in .epw or .wea and begins every message.
Weather parse_weather(const std::string& bytes, const std::string& name);

/// The hour in which a moment lies, by month, day and hour of local standard time: the years of a file are a choice of
/// typical months. Throws Error when the file has none.
const WeatherHour& hour_at(const Weather& weather, const Moment& moment);

/// The moment of the middle of an hour in a year.
Moment middle_of(const Weather& weather, const WeatherHour& hour, int year);

}  // namespace lw
