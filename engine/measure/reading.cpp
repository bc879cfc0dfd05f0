#include "measure/reading.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "image/tonemap.h"

namespace lw {
namespace {

constexpr double normal_90 = 1.645;   // two-sided 90 % of a normal distribution
constexpr double student_90 = 1.895;  // of Student's t with repetitions - 1 = 7 degrees of freedom
static_assert(repetitions == 8);
/// Even rays that all miss a small bright thing agree with each other. What they gain over random ones is not believed
/// beyond this part of the random error.
constexpr double least_of_scatter = 0.25;

/// Why a number should not be signed, or "".
std::string doubt_of(const Reading& reading, const Value& value) {
    char text[96] = "";
    if (reading.blocked) return "inside or right under an object";
    const auto dark = [](vec3 lamp) { return lamp == vec3(0); };
    if (std::all_of(reading.lamps.begin(), reading.lamps.end(), dark)) return "no light found";
    if (reading.photons < 100 && value.photon_error > 0.02 * value.lux) {
        std::snprintf(text, sizeof text, "too few photons (%.0f effective)", double(reading.photons));
    } else if (value.relative() > 0.1) {
        std::snprintf(text, sizeof text, "interval wider than 10 %%: %s",
                      value.ray_error > value.photon_error ? "more rays" : "more photons");
    }
    return text;
}

}  // namespace

double lux_of_lamp(const Reading& reading, const Scene& scene, size_t lamp) {
    return double(luminance(reading.lamps[lamp] * scene.lights[lamp].intensity));
}

double photon_map_lux(const Reading& reading, const std::vector<float>& factors, float maintenance) {
    double lux = 0;
    for (size_t lamp = 0; lamp < reading.photon_map.size(); ++lamp)
        lux += double(factors[lamp] * maintenance * reading.photon_map[lamp]);
    return lux;
}

Value value_of(const Reading& reading, const Scene& scene, const std::vector<float>& factors, float maintenance) {
    const size_t count = reading.lamps.size();
    Value value;
    double photon_variance = 0, scatter = 0, by_photons = 0, deviation2 = 0;
    for (size_t lamp = 0; lamp < count; ++lamp) {
        const double factor = double(factors[lamp] * maintenance);
        value.lux += factor * lux_of_lamp(reading, scene, lamp);
        by_photons += factor * double(reading.by_photons[lamp]);
        scatter += factor * std::sqrt(double(reading.scatter[lamp]));
        photon_variance += factor * factor * double(reading.photon_variance[lamp]);
    }
    for (uint r = 0; r < repetitions; ++r) {
        double lux = 0;
        for (size_t lamp = 0; lamp < count; ++lamp)
            lux += double(factors[lamp] * maintenance) * double(reading.repeated[r * count + lamp]);
        deviation2 += (lux - value.lux) * (lux - value.lux);
    }
    const double spread = std::sqrt(deviation2 / (repetitions - 1) / repetitions);
    value.ray_error = std::max(spread, least_of_scatter * scatter);
    value.photon_error = std::hypot(std::sqrt(photon_variance), double(reading.kernel_bias) * by_photons);
    value.half_width = std::hypot(student_90 * value.ray_error, normal_90 * value.photon_error);
    value.doubt = doubt_of(reading, value);
    return value;
}

}  // namespace lw
