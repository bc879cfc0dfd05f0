#include "measure/reading.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace lw {
namespace {

constexpr double normal_90 = 1.645;   // two-sided 90 % of a normal distribution
constexpr double student_90 = 1.895;  // of Student's t with repetitions - 1 = 7 degrees of freedom
static_assert(repetitions == 8);
/// Quasi-random rays that all miss a small bright source agree with each other. So the error of the rays is taken as at
/// least this part of the error that random rays would have.
constexpr double min_of_scatter = 0.25;
constexpr double min_photons = 100;

/// The reason not to trust a value, or "".
std::string doubt_of(const Reading& reading, const Value& value) {
    char text[96] = "";
    if (reading.blocked) return "inside or right under an object";
    if (reading.at_lamp) return "within 1 cm of a lamp without size";
    if (is_dark(reading)) return "no light found";
    if (value.photons < min_photons && value.photon_error > 0.02 * value.lux) {
        std::snprintf(text, sizeof text, "too few photons (%.0f effective)", value.photons);
    } else if (value.relative() > 0.1) {
        std::snprintf(text, sizeof text, "interval wider than 10 %%: %s",
                      value.ray_error > value.photon_error ? "more rays" : "more photons");
    } else if (reading.near_border) {
        return "within 1 cm of a border";
    }
    return text;
}

/// The standard error of a sum over the channels, from their variances. Assumes that the channels err together, which
/// gives an upper bound.
double joined_error(vec3 factor, ChannelLux variance) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += double(factor[c]) * std::sqrt(double(variance[c]));
    return sum;
}

double sum_of(vec3 factor, ChannelLux lux) {
    return double(factor.x) * double(lux.x) + double(factor.y) * double(lux.y) + double(factor.z) * double(lux.z);
}

/// Standard error of the mean of the repetitions.
double spread_of(const Reading& reading, std::span<const vec3> factors, double mean) {
    const size_t count = reading.lamps.size();
    double deviation2 = 0;
    for (uint r = 0; r < repetitions; ++r) {
        double lux = 0;
        for (size_t lamp = 0; lamp < count; ++lamp) lux += sum_of(factors[lamp], reading.repeated[r * count + lamp]);
        deviation2 += (lux - mean) * (lux - mean);
    }
    return std::sqrt(deviation2 / (repetitions - 1) / repetitions);
}

}  // namespace

bool is_dark(const Reading& reading) {
    return std::all_of(reading.lamps.begin(), reading.lamps.end(), [](ChannelLux lamp) { return lamp == vec3(0); });
}

void check_is_light(std::span<const Reading> readings) {
    for (size_t i = 0; i < readings.size(); ++i)
        for (const std::vector<ChannelLux>* values :
             {&readings[i].lamps, &readings[i].repeated, &readings[i].scatter, &readings[i].photon_variance,
              &readings[i].by_photons, &readings[i].blur})
            for (const ChannelLux& lux : *values)
                for (int c = 0; c < 3; ++c)
                    if (!std::isfinite(lux[c]) || lux[c] < 0)
                        throw Error("sensor " + std::to_string(i + 1) + " reads " + std::to_string(lux[c]) +
                                    ", which is no light");
}

double lux_of_lamp(const Reading& reading, size_t lamp, vec3 factor) { return sum_of(factor, reading.lamps[lamp]); }

Value value_of(const Reading& reading, std::span<const vec3> factors, float maintenance) {
    Value value;
    double variance = 0, scatter = 0, by_photons = 0, blur = 0;
    for (size_t lamp = 0; lamp < reading.lamps.size(); ++lamp) {
        value.lux += lux_of_lamp(reading, lamp, factors[lamp]);
        by_photons += sum_of(factors[lamp], reading.by_photons[lamp]);
        blur += sum_of(factors[lamp], reading.blur[lamp]);
        scatter += sum_of(factors[lamp], reading.scatter[lamp]);
        const double error = joined_error(factors[lamp], reading.photon_variance[lamp]);
        variance += error * error;
    }
    const double kernels = double(reading.kernel_bias) * by_photons;
    const double rays = std::max(spread_of(reading, factors, value.lux), min_of_scatter * scatter);
    value.lux *= double(maintenance);
    value.ray_error = double(maintenance) * rays;
    value.photon_error = double(maintenance) * std::sqrt(variance + kernels * kernels + blur * blur);
    value.photons = variance > 0 ? by_photons * by_photons / variance : 0;
    value.half_width = std::hypot(student_90 * value.ray_error, normal_90 * value.photon_error);
    value.doubt = doubt_of(reading, value);
    return value;
}

}  // namespace lw
