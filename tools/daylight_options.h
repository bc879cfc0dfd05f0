// The options of daylight, the same in every program.
#pragma once
#include "daylight/options.h"
#include "number_option.h"

namespace lw {

/// Adds the options; what they say together, misuse_of(options) judges after the command line is read.
inline void add_daylight(CLI::App& app, DaylightOptions& options) {
    app.add_option("--sky", options.sky,
                   "the sky: cie:1 to cie:15, clear, intermediate, overcast, uniform, perez, or none; default: none, "
                   "with --epw perez");
    app.add_option("--sun", options.sun, "ALTITUDE,AZIMUTH of the sun in degrees, azimuth clockwise from north");
    app.add_option("--place", options.place,
                   "LATITUDE,LONGITUDE in degrees, north and east positive; default: that of the weather file");
    app.add_option("--when", options.when, "date and time with its offset from UTC, such as 2026-06-21T15:00+02:00");
    app.add_option("--epw", options.weather, "weather file, .epw or .wea, of which --when chooses the hour");
    app.add_option("--diffuse", options.diffuse,
                   "lux of the sky on an open horizontal plane; default: as the weather file or the mean of such skies")
        ->check(finite_number(0, 1e6));
    app.add_option("--direct", options.direct,
                   "lux of the sun on a plane that faces it; default: as the weather file or the mean of such skies")
        ->check(finite_number(0, 1e6));
    app.add_option("--north", options.north, "degrees from -Z to north, clockwise seen from above")
        ->capture_default_str()
        ->check(finite_number(-360, 360));
    app.add_option("--ground-albedo", options.ground_albedo,
                   "part of the light that the ground around the scene reflects, from 0 to 1")
        ->capture_default_str()
        ->check(finite_number(0, 1));
    app.add_flag("--grey-sky", options.grey, "sky and sun without colour; default: by their colour temperature");
}

}  // namespace lw
