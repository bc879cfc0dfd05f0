#include "daylight/moment.h"

#include <array>
#include <chrono>
#include <cmath>

namespace lw {
namespace {

using std::chrono::day, std::chrono::days, std::chrono::month, std::chrono::sys_days, std::chrono::year,
    std::chrono::year_month_day;

/// Reads a text from left to right; `good` turns false at the first thing that is not as expected.
struct Reading {
    const std::string& text;
    size_t at = 0;
    bool good = true;

    /// A number of exactly `digits` digits, at most `most`.
    int number(int digits, int most) {
        int value = 0;
        for (int i = 0; i < digits; ++i, ++at) {
            good = good && at < text.size() && text[at] >= '0' && text[at] <= '9';
            if (!good) return 0;
            value = 10 * value + (text[at] - '0');
        }
        good = value <= most;
        return value;
    }
    bool next_is(char c) const { return at < text.size() && text[at] == c; }
    void expect(char c) {
        good = good && next_is(c);
        ++at;
    }
    /// "+02:00", "-0930" or "Z", in minutes.
    int offset() {
        if (next_is('Z')) return ++at, 0;
        const int sign = next_is('-') ? -1 : 1;
        if (sign > 0)
            expect('+');
        else
            ++at;
        const int hours = number(2, 14);
        if (next_is(':')) ++at;
        return sign * (60 * hours + number(2, 59));
    }
};

}  // namespace

std::optional<Moment> parse_moment(const std::string& text) {
    Reading reading{text};
    std::array<int, 6> parts{};  // year, month, day, hour, minute, second
    parts[0] = reading.number(4, 2100);
    reading.expect('-');
    parts[1] = reading.number(2, 12);
    reading.expect('-');
    parts[2] = reading.number(2, 31);
    reading.expect('T');
    parts[3] = reading.number(2, 23);
    reading.expect(':');
    parts[4] = reading.number(2, 59);
    if (reading.next_is(':')) ++reading.at, parts[5] = reading.number(2, 59);
    const int offset = reading.offset();
    const year_month_day date{year(parts[0]), month(unsigned(parts[1])), day(unsigned(parts[2]))};
    if (!reading.good || reading.at != text.size() || !date.ok() || parts[0] < 1900) return std::nullopt;
    const int64_t minutes = 60 * parts[3] + parts[4] - offset;
    return Moment{int64_t(sys_days(date).time_since_epoch().count()) * 86400 + minutes * 60 + parts[5], offset};
}

ClockTime clock_time(const Moment& moment, int offset) {
    const int64_t seconds = moment.seconds + 60 * int64_t(offset);
    const int64_t whole_days = seconds >= 0 ? seconds / 86400 : -((86399 - seconds) / 86400);
    const year_month_day date{sys_days(days(whole_days))};
    return {int(date.year()), int(unsigned(date.month())), int(unsigned(date.day())),
            double(seconds - 86400 * whole_days) / 3600};
}

Moment moment_of(const ClockTime& time, int offset) {
    const year_month_day date{year(time.year), month(unsigned(time.month)), day(unsigned(time.day))};
    const auto seconds = int64_t(std::lround(time.hour * 3600));
    return {int64_t(sys_days(date).time_since_epoch().count()) * 86400 + seconds - 60 * int64_t(offset), offset};
}

double julian_day(const Moment& moment) { return 2440587.5 + double(moment.seconds) / 86400; }

}  // namespace lw
