// The daylight that the options of a program ask for, from their texts to a Daylight.
#pragma once
#include <memory>
#include <string>

#include "daylight/daylight.h"

namespace lw {

/// As they are given; an empty text or a negative number was not.
struct DaylightOptions {
    std::string sky;          // cie:1 to cie:15, clear, intermediate, overcast, uniform, perez, none
    std::string sun;          // ALTITUDE,AZIMUTH in degrees
    std::string place, when;  // LATITUDE,LONGITUDE in degrees; a moment (moment.h)
    std::string weather;      // path of a weather file
    double diffuse = -1;      // lx
    double direct = -1;       // lx on a plane that faces the sun
    double north = 0;         // degrees from -Z to north, clockwise seen from above
    double ground_albedo = 0.2;
    bool grey = false;  // sky and sun without colour
};

/// What is wrong with the options, in a line that begins with the name of one, or "". Files are not read.
std::string misuse_of(const DaylightOptions& options);

/// The daylight of options without misuse, or nullptr when they ask for none. Throws Error for a weather file that
/// cannot be read or lacks the hour.
std::unique_ptr<const Daylight> make_daylight(const DaylightOptions& options);

/// True when options ask for a sky.
bool wants_daylight(const DaylightOptions& options);

}  // namespace lw
