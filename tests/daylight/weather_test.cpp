// Weather files: whose hour is which, and files that are damaged.
#include "daylight/weather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"

namespace lw {
namespace {

using test::error_of;

const std::string epw_head =
    "LOCATION,Wien,-,AUT,IWEC,110360,48.12,16.57,1.0,190.0\r\n"
    "DESIGN CONDITIONS,0\r\nTYPICAL/EXTREME PERIODS,0\r\nGROUND TEMPERATURES,0\r\n"
    "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\r\nCOMMENTS 1,made by hand\r\nCOMMENTS 2\r\n"
    "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\r\n";

std::string epw_hour(const std::string& date, const std::string& direct, const std::string& diffuse) {
    return date + ",60,A7,20.0,11.5,50,99000,0,0,350," + "500," + direct + "," + diffuse + ",9999,9999,9999\r\n";
}

const std::string epw = epw_head + epw_hour("1990,6,21,12", "700", "120") + epw_hour("1990,6,21,13", "710", "125") +
                        epw_hour("1987,12,31,24", "0", "0");

const std::string wea =
    "place Wien\nlatitude 48.12\nlongitude -16.57\ntime_zone -15\nsite_elevation 190\nweather_data_file_units 1\n"
    "6 21 11.5 700 120\n6 21 12.500 710 125\n12 31 23.5 0 0\n";

TEST(Weather, NamesAnHourByItsEndAndHasTheSunAtItsMiddle) {
    for (const Weather& weather : {parse_weather(epw, "a.epw"), parse_weather(wea, "a.WEA")}) {
        EXPECT_DOUBLE_EQ(weather.place.latitude, 48.12);
        EXPECT_DOUBLE_EQ(weather.place.longitude, 16.57);
        EXPECT_EQ(weather.offset, 60);
        ASSERT_EQ(weather.hours.size(), 3u);
        // Half past one by summer time, two hours ahead, is half past eleven universal and half past twelve standard.
        const WeatherHour& hour = hour_at(weather, *parse_moment("2026-06-21T13:40+02:00"));
        EXPECT_EQ(hour.direct_normal, 710);
        EXPECT_EQ(hour.diffuse_horizontal, 125);
        EXPECT_EQ(middle_of(weather, hour, 2026).seconds, parse_moment("2026-06-21T11:30Z")->seconds);
        EXPECT_EQ(hour_at(weather, *parse_moment("2026-06-21T11:59:59+01:00")).direct_normal, 700);
        EXPECT_EQ(hour_at(weather, *parse_moment("2026-06-21T12:00+01:00")).direct_normal, 710);
        EXPECT_EQ(hour_at(weather, *parse_moment("2026-12-31T23:59+01:00")).direct_normal, 0);
        EXPECT_NE(error_of([&] { hour_at(weather, *parse_moment("2026-06-21T13:00+01:00")); }).find("has no hour"),
                  std::string::npos);
    }
    EXPECT_EQ(parse_weather(epw, "a.epw").hours[0].dew_point, 11.5);
}

TEST(Weather, OfDamagedFilesIsRefusedWithTheLine) {
    struct Damage {
        const std::string& text;
        const char *name, *from, *to, *message;
    };
    const Damage damages[] = {
        {epw, "LOCATION", "LOCATION", "PLACE", "line 1: this line must begin with LOCATION"},
        {epw, "latitude", "48.12", "148.12", "the latitude must be from -90 to 90"},
        {epw, "zone", ",1.0,", ",x,", "the time zone: \"x\" is not a number"},
        {epw, "records", "DATA PERIODS,1,1", "DATA PERIODS,1,4", "one record an hour"},
        {epw, "month", "6,21,12,", "13,21,12,", "line 9: the month must be from 1 to 12"},
        {epw, "day", "6,21,12,", "6,31,12,", "there is no such day"},
        {epw, "hour", "6,21,12,", "6,21,0,", "the hour must be from 1 to 24"},
        {epw, "missing", ",700,", ",9999,", "direct normal irradiance was not measured"},
        {epw, "negative", ",125,", ",-1,", "line 10: the diffuse horizontal irradiance was not"},
        {epw, "large", ",700,", ",3000,", "is larger than 2000 W/m2"},
        {epw, "infinite", ",700,", ",inf,", "is not a number"},
        {epw, "huge", ",700,", ",1e999,", "is not a number"},
        {wea, "units", "units 1", "units 2", "only units 1 are read"},
        {wea, "word", "longitude", "longtitude", "this line must begin with longitude"},
        {wea, "short", "6 21 11.5 700 120", "6 21 11.5 700", "the diffuse horizontal irradiance is missing"}};
    for (const Damage& d : damages) {
        std::string text = d.text;
        text.replace(text.find(d.from), std::string(d.from).size(), d.to);
        const std::string name = &d.text == &epw ? "hurt.epw" : "hurt.wea";
        const std::string told = error_of([&] { parse_weather(text, name); });
        EXPECT_EQ(told.rfind(name + ": line ", 0), 0u) << d.name << ": " << told;
        EXPECT_NE(told.find(d.message), std::string::npos) << d.name << ": " << told;
    }
    EXPECT_EQ(error_of([] { parse_weather(epw, "a.txt"); }), "a.txt: weather files end in .epw or .wea");
    EXPECT_EQ(error_of([] { load_weather("/nowhere/a.epw"); }), "/nowhere/a.epw: cannot be opened");
    EXPECT_NE(error_of([] { parse_weather(epw_head, "a.epw"); }).find("the file has no hours"), std::string::npos);
}

TEST(Weather, CutAnywhereIsReadOrRefusedInOneLine) {
    for (const auto& [text, name] : {std::pair(epw, "cut.epw"), std::pair(wea, "cut.wea")})
        for (size_t length = 0; length < text.size(); ++length) {
            const std::string told = error_of([&] {
                for (const WeatherHour& hour : parse_weather(text.substr(0, length), name).hours)
                    EXPECT_TRUE(hour.direct_normal >= 0 && hour.direct_normal <= 2000) << length;
            });
            EXPECT_EQ(told.find('\n'), std::string::npos);
        }
}

TEST(Weather, OfMoreThanAYearIsRefused) {
    std::string text = wea;
    for (int i = 0; i < 8800; ++i) text += "1 1 0.5 0 0\n";
    EXPECT_NE(error_of([&] { parse_weather(text, "long.wea"); }).find("more than the hours of a year"),
              std::string::npos);
}

}  // namespace
}  // namespace lw
