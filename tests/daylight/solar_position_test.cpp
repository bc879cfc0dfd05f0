// The sun's position against published examples and against the algorithm of Reda & Andreas (NREL/TP-560-34302, 2008).
#include "daylight/solar_position.h"

#include <gtest/gtest.h>

#include <cmath>

#include "daylight/moment.h"

namespace lw {
namespace {

/// The distance of two azimuths in degrees of the sky.
double turn_between(double a, double b, double altitude) {
    return std::abs(std::remainder(a - b, 360.0)) * std::cos(altitude * 3.14159265 / 180);
}

TEST(SolarPosition, IsThatOfTheExampleOfRedaAndAndreas) {
    // NREL/TP-560-34302 (2008), table A5.1: 17 October 2003, 12:30:30 in time zone -7, 820 mbar, 11 degrees.
    const double day = julian_day(*parse_moment("2003-10-17T12:30:30-07:00"));
    EXPECT_NEAR(day, 2452930.312847, 1e-6);
    const SunPosition sun = sun_position({39.742476, -105.1786}, day);
    EXPECT_NEAR(sun.altitude, 39.872046, 0.001);
    EXPECT_NEAR(sun.altitude + refraction(sun.altitude, {820, 11}), 39.888378, 0.001);
    EXPECT_NEAR(sun.azimuth, 194.340241, 0.001);
    EXPECT_NEAR(sun.distance, 0.9965423, 1e-5);
}

TEST(SolarPosition, IsThatOfTheExampleOfMeeus) {
    // Astronomical Algorithms (1998), example 25.b: 13 October 1992 at 0 h dynamical time, 59 s ahead of universal
    // time.
    const double day = 2448908.5 - 59.0 / 86400;
    const SunPosition sun = sun_position({90, 0}, day);  // at the pole the altitude is the declination
    EXPECT_NEAR(sun.altitude + 8.794 / 3600, -(7 + 47.0 / 60 + 1.74 / 3600), 0.0005);
    EXPECT_NEAR(sun.distance, 0.99760775, 1e-5);
}

TEST(SolarPosition, IsThatOfRedaAndAndreasAllOverTheWorld) {
    // Computed by pvlib 0.16, solarposition.spa_python: without and with refraction.
    struct Case {
        const char* when;
        Place place;
        double altitude, azimuth, apparent;
    };
    constexpr Case cases[] = {{"2026-06-21T15:00+02:00", {48.2082, 16.3738}, 55.195266, 235.682148, 55.206963},
                              {"2026-12-21T08:30-05:00", {40.7, -74.0}, 10.259792, 133.542233, 10.347487},
                              {"1999-03-01T00:10+00:00", {-33.9, 151.2}, 52.391742, 52.901451, 52.404704},
                              {"2040-09-23T18:20+05:30", {28.6, 77.2}, -1.677305, 270.413050, -1.677305},
                              {"2010-07-01T23:00+01:00", {69.6, 18.9}, 3.070196, 348.882085, 3.293893}};
    for (const Case& c : cases) {
        const double day = julian_day(*parse_moment(c.when));
        const SunPosition sun = sun_position(c.place, day);
        EXPECT_NEAR(sun.altitude, c.altitude, 0.001) << c.when;
        EXPECT_LT(turn_between(sun.azimuth, c.azimuth, c.altitude), 0.001) << c.when;
        EXPECT_NEAR(apparent_sun_position(c.place, day).altitude, c.apparent, 0.001) << c.when;
    }
}

TEST(Moment, IsReadWithItsOffset) {
    const auto moment = parse_moment("2026-06-21T15:00+02:00");
    ASSERT_TRUE(moment);
    EXPECT_EQ(moment->seconds, 1782046800);
    EXPECT_EQ(moment->offset, 120);
    EXPECT_EQ(parse_moment("2026-06-21T13:00:00Z")->seconds, moment->seconds);
    EXPECT_EQ(parse_moment("2026-06-21T09:30-0330")->seconds, moment->seconds);
    const ClockTime time = clock_time(*moment, 60);
    EXPECT_EQ(time.year, 2026);
    EXPECT_EQ(time.month, 6);
    EXPECT_EQ(time.day, 21);
    EXPECT_DOUBLE_EQ(time.hour, 14);
    EXPECT_EQ(moment_of(time, 60).seconds, moment->seconds);
    EXPECT_EQ(clock_time({-1, 0}, 0).year, 1969);
    EXPECT_EQ(clock_time({-1, 0}, 0).day, 31);
}

TEST(Moment, IsRefusedWithoutOffsetOrDay) {
    for (const char* text :
         {"", "2026-06-21", "2026-06-21T15:00", "2026-06-21T15:00+", "2026-06-21T15:00+2", "2026-06-21T15:00+02:0",
          "2026-06-21T15:00+02:00x", "2026-06-31T15:00Z", "2025-02-29T15:00Z", "2026-13-01T15:00Z", "2026-06-21T24:00Z",
          "2026-06-21T15:60Z", "2026-06-21 15:00Z", "0026-06-21T15:00Z", "2026-06-21T15:00+15:00", "2026-6-21T15:00Z"})
        EXPECT_FALSE(parse_moment(text)) << text;
}

}  // namespace
}  // namespace lw
