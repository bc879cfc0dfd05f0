// Clocks of the benchmark: wall time, CPU time of the whole process, peak memory; medians and power laws.
#pragma once
#include <functional>
#include <vector>

namespace lw {

double median(std::vector<double> values);

/// Median wall time of `runs` calls, ms.
double median_ms(unsigned runs, const std::function<void()>& work);

/// What a piece of work took.
struct Cost {
    double seconds = 0;      // wall
    double cpu_seconds = 0;  // user + system, all threads
};

Cost cost_of(const std::function<void()>& work);

/// Returns freed memory to the system and forgets the peak so far, so that earlier sections do not count (Linux,
/// glibc).
/// Returns what the process still holds, MB.
double reset_peak_memory();
/// Peak resident memory of the process since the last reset, MB.
double peak_memory_mb();

/// Exponent b of y = a x^b by least squares in logarithms; NaN with fewer than two different x. Values <= 0 are left
/// out.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace lw
