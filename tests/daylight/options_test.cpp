// From the texts of options to a daylight.
#include "daylight/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error_of.h"
#include "programs/command.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

DaylightOptions with_sky(const std::string& sky, const std::string& sun = "") {
    DaylightOptions options;
    options.sky = sky, options.sun = sun;
    return options;
}

TEST(DaylightOptions, ThatSayNothingAskForDarkness) {
    for (const DaylightOptions& options : {DaylightOptions{}, with_sky("none", "30,180")}) {
        EXPECT_EQ(misuse_of(options), "");
        EXPECT_FALSE(wants_daylight(options));
        EXPECT_EQ(make_daylight(options), nullptr);
    }
}

TEST(DaylightOptions, AreRefusedWithTheNameOfTheOption) {
    DaylightOptions no_sky, two_suns = with_sky("clear", "30,180"), no_hour, no_place = with_sky("clear");
    no_sky.diffuse = 10'000;
    two_suns.place = "48,16";
    no_hour.weather = "a.epw";
    no_place.when = "2026-06-21T15:00+02:00";
    DaylightOptions no_offset = with_sky("clear"), far = with_sky("clear");
    no_offset.when = "2026-06-21T15:00", no_offset.place = "48,16";
    far.when = no_place.when, far.place = "98,16";
    const std::pair<DaylightOptions, const char*> cases[] = {{with_sky("cie:16"), "--sky: must be"},
                                                             {with_sky("cie:0"), "--sky: must be"},
                                                             {with_sky("Clear"), "--sky: must be"},
                                                             {with_sky("clear"), "--sky: needs the sun"},
                                                             {with_sky("uniform"), "--sky: needs the sun"},
                                                             {with_sky("clear", "30"), "--sun: must be"},
                                                             {with_sky("clear", "91,0"), "--sun: must be"},
                                                             {with_sky("clear", "nan,0"), "--sun: must be"},
                                                             {with_sky("clear", "3,4,5"), "--sun: must be"},
                                                             {with_sky("perez", "30,180"), "--sky perez: needs"},
                                                             {no_sky, "--sky: is needed"},
                                                             {two_suns, "--sun: leaves"},
                                                             {no_hour, "--when: is needed"},
                                                             {no_offset, "--when: must be"},
                                                             {far, "--place: must be"},
                                                             {no_place, "--sky: needs the sun"}};
    for (const auto& [options, message] : cases) EXPECT_EQ(misuse_of(options).rfind(message, 0), 0u) << message;
}

TEST(DaylightOptions, GiveTheMeanLightOfTheirSky) {
    // IES 1984, table 1, at 30 degrees.
    const struct {
        const char* sky;
        double diffuse, direct;
    } cases[] = {{"overcast", 300 + 21'000 * 0.5, 0},
                 {"cie:5", 300 + 21'000 * 0.5, 0},
                 {"intermediate", 300 + 45'000 * 0.5, 127'500 * std::exp(-0.80 / 0.5)},
                 {"clear", 800 + 15'500 * std::sqrt(0.5), 127'500 * std::exp(-0.21 / 0.5)}};
    for (const auto& c : cases) {
        const auto light = make_daylight(with_sky(c.sky, "30,180"));
        EXPECT_NEAR(light->settings().diffuse, c.diffuse, 1e-6 * c.diffuse) << c.sky;
        EXPECT_NEAR(light->settings().direct, c.direct, 1e-6 * c.direct) << c.sky;
    }
    EXPECT_EQ(make_daylight(with_sky("clear", "-1,180"))->settings().diffuse, 0);
    DaylightOptions given = with_sky("cie:12", "30,180");
    given.diffuse = 10'000, given.direct = 0;
    EXPECT_EQ(make_daylight(given)->settings().diffuse, 10'000);
    EXPECT_EQ(make_daylight(given)->settings().direct, 0);
}

TEST(DaylightOptions, TurnNorth) {
    DaylightOptions options = with_sky("clear", "0,90");
    const auto expect_sun = [&](vec3 wanted) {
        EXPECT_LT(length(make_daylight(options)->to_sun() - wanted), 1e-6f) << options.north;
    };
    expect_sun({1, 0, 0});  // east is +X when north is -Z
    options.north = 90;
    expect_sun({0, 0, 1});
    options.sun = "90,0";
    expect_sun({0, 1, 0});
}

TEST(DaylightOptions, ColourLightWithoutChangingIt) {
    DaylightOptions options = with_sky("clear", "30,180");
    const vec3 up(0, 1, 0);
    const auto coloured = make_daylight(options);
    options.grey = true;
    const auto grey = make_daylight(options);
    EXPECT_NEAR(double(luminance(coloured->radiance(up)) / luminance(grey->radiance(up))), 1, 1e-5);
    EXPECT_NEAR(double(luminance(coloured->sun_radiance()) / luminance(grey->sun_radiance())), 1, 1e-5);
    EXPECT_GT(coloured->radiance(up).z, 1.2f * coloured->radiance(up).x);
    EXPECT_GT(coloured->sun_radiance().x, 1.2f * coloured->sun_radiance().z);
    EXPECT_EQ(grey->radiance(up).x, grey->radiance(up).z);
}

TEST(DaylightOptions, TakeTheHourOfAWeatherFile) {
    const TempFolder folder;
    write_text(folder / "a.wea",
               "place Wien\nlatitude 48.12\nlongitude -16.57\ntime_zone -15\nsite_elevation 190\n"
               "weather_data_file_units 1\n6 21 14.5 700 120\n");
    DaylightOptions options;
    options.weather = folder / "a.wea", options.when = "2026-06-21T15:05+02:00";
    EXPECT_EQ(misuse_of(options), "");
    EXPECT_TRUE(wants_daylight(options));
    const DaylightSettings at_hour = make_daylight(options)->settings();
    EXPECT_GT(at_hour.direct, 700 * 90);
    EXPECT_GT(at_hour.diffuse, 120 * 100);
    EXPECT_EQ(at_hour.shape.floor, 1);
    DaylightOptions at_middle = with_sky("clear");
    at_middle.place = "48.12,16.57", at_middle.when = "2026-06-21T14:30+01:00";
    EXPECT_EQ(make_daylight(at_middle)->settings().altitude, at_hour.altitude);
    EXPECT_EQ(make_daylight(at_middle)->settings().azimuth, at_hour.azimuth);
    options.when = "2026-06-21T14:05+02:00";
    EXPECT_EQ(test::error_of([&] { make_daylight(options); }), options.weather + ": has no hour for 06-21, 13.08 h");
}

TEST(Daylight, HasASunOfItsSizeAndAGroundThatIsLit) {
    DaylightOptions options = with_sky("clear", "30,180");
    options.grey = true, options.direct = 20'000, options.diffuse = 10'000;
    const auto light = make_daylight(options);
    const double radius = 0.2665 * pi / 180;
    EXPECT_NEAR(double(light->sun_radiance().y) * pi * std::sin(radius) * std::sin(radius), 20'000, 20);
    EXPECT_TRUE(light->is_sun(direction_to(30.26, 180, 0)));
    EXPECT_FALSE(light->is_sun(direction_to(30.27, 180, 0)));
    EXPECT_NEAR(double(light->radiance(vec3(0, -1, 0)).x), 0.2 * 20'000 / pi, 1);
    options.sun = "-3,180";
    const auto night = make_daylight(options);
    EXPECT_EQ(night->sun_radiance(), vec3(0));
    EXPECT_NEAR(double(night->radiance(vec3(0, -1, 0)).x), 0.2 * 10'000 / pi, 1);
}

}  // namespace
}  // namespace lw
