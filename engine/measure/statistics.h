// The numbers that a lighting report states of a field (a grid or a surface), with 90 % intervals.
#pragma once
#include <span>
#include <string>

#include "measure/reading.h"
#include "measure/task.h"

namespace lw {

/// A number and half the width of its 90 % interval.
struct Estimate {
    double value = 0;
    double half_width = 0;
};

struct Statistics {
    Estimate minimum, average, maximum;  // lx
    Estimate u0;                         // minimum / average
    Estimate ud;                         // minimum / maximum
    size_t count = 0;                    // sensors counted
    size_t blocked = 0;                  // sensors left out: inside or right under an object
    size_t doubtful = 0;                 // sensors that should not be trusted
    size_t unlit = 0;                    // sensors that no lamp reaches: most likely outside the room
};

/// The statistics of a field from the readings and values of its sensors. All sensors use the same photons, so the
/// errors of the photons are taken as common to all, which gives an upper bound; the errors of rays are independent.
/// `sampled`: the sensors are samples of a surface, so the spread of their values adds to the error of the mean; the
/// points of a grid are exactly what is asked for.
Statistics statistics_of(std::span<const Reading> readings, std::span<const Value> values, bool sampled = false);

enum class Verdict { pass, fail, undecided };

struct Judgement {
    Verdict illuminance, uniformity;
    Verdict both() const;
};

/// Whether a field meets the requirements of a task. Undecided when the required value lies within the interval, or
/// when no sensor counts.
Judgement judge(const Statistics& statistics, const Task& task);

std::string name_of(Verdict verdict);

}  // namespace lw
