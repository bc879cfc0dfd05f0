// Sums of a field: what a lighting report states of a grid or a surface, with 90 % intervals.
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
    size_t blocked = 0;                  // sensors left out: inside or right under something
    size_t doubtful = 0;                 // sensors that should not be trusted
    size_t unlit = 0;                    // sensors that no lamp reaches: most likely outside the room
};

/// Photons are shared by all sensors of a field, so their errors are taken as common to all (an upper bound); those of
/// the rays are independent. `sampled`: the sensors stand for a surface that they sample (its mean is uncertain by
/// their spread); those of a grid are what is asked for.
Statistics statistics_of(std::span<const Reading> readings, std::span<const Value> values, bool sampled = false);

enum class Verdict { pass, fail, undecided };

struct Judgement {
    Verdict illuminance, uniformity;
    Verdict both() const;
};

/// Undecided when the requirement lies within the interval, or when no sensor counts.
Judgement judge(const Statistics& statistics, const Task& task);

std::string name_of(Verdict verdict);

}  // namespace lw
