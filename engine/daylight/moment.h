// A moment in time, written with its distance from universal time, as the sun's position needs it.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace lw {

struct Moment {
    int64_t seconds = 0;  // universal time, since 1970-01-01T00:00
    int offset = 0;       // minutes by which the clock of the place is ahead of universal time
};

/// A day and an hour of a clock that is `offset` minutes ahead of universal time.
struct ClockTime {
    int year, month, day;  // month and day from 1
    double hour;           // from 0 to below 24
};

/// Parses "2026-06-21T15:00+02:00", with seconds "2026-06-21T15:00:30Z". nullopt for anything else: a text without an
/// offset, a day that the calendar lacks, a year outside 1900 to 2100.
std::optional<Moment> parse_moment(const std::string& text);

/// What a clock that is `offset` minutes ahead of universal time shows at a moment.
ClockTime clock_time(const Moment& moment, int offset);

/// The moment at which a clock that is `offset` minutes ahead of universal time shows a time. The hour may be outside 0
/// to 24.
Moment moment_of(const ClockTime& time, int offset);

/// Days of universal time since noon of 1 January 4713 B.C. (Meeus 1998, chapter 7).
double julian_day(const Moment& moment);

}  // namespace lw
