// The reading of a sensor: lux of each lamp and colour channel at the power in the scene file, so that the value in any
// ambiance is a weighted sum, and the data for its error. The interval of a value holds the true value in about 90 % of
// cases (docs/measuring.md).
#pragma once
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lw {

/// The parts of an illuminance that red, green and blue bring, lx: each channel times its weight in luminance, so that
/// the three add up to lux. A lamp's RGB factor multiplies them channel by channel.
using ChannelLux = vec3;

/// Independent repetitions of the rays of a sensor; their spread is the error of the rays.
constexpr uint repetitions = 8;

/// What one sensor read. All values are at the powers in the file, and arrays have one entry per lamp unless said
/// otherwise.
struct Reading {
    std::vector<ChannelLux> lamps;
    std::vector<ChannelLux> repeated;         // repetition r of lamp l at r * lamps + l
    std::vector<ChannelLux> scatter;          // standard error that independent random rays would have
    std::vector<ChannelLux> photon_variance;  // lx2
    std::vector<ChannelLux> by_photons;       // the part of `lamps` that comes from photons of the map
    std::vector<ChannelLux> blur;             // largest error by the kernel's blur of a caustic on the sensor itself
    float kernel_bias = 0;                    // bias of the kernels at other surfaces, as a part of by_photons
    uint rays = 0;
    bool blocked = false;      // inside an object or right under one
    bool near_border = false;  // is_near_border()
    bool at_lamp = false;      // is_at_lamp()
};

/// The value of a sensor in an ambiance: lux and half the width of its 90 % interval.
struct Value {
    double lux = 0;
    double half_width = 0;
    double ray_error = 0;     // standard error of the rays, lx
    double photon_error = 0;  // standard error of the photons, their bias included, lx
    double photons = 0;       // effective number of independent photons in the light that photons bring
    std::string doubt;        // why not to trust it, or ""

    double relative() const { return lux > 0 ? half_width / lux : 0; }
};

/// The value with lamp l at `factors[l]` (RGB) times its power in the file, all times the maintenance factor.
Value value_of(const Reading& reading, std::span<const vec3> factors, float maintenance = 1);

/// True when the reading of every lamp is zero.
bool is_dark(const Reading& reading);

/// Throws Error with the number of the sensor when a reading is NaN, infinite or negative.
void check_is_light(std::span<const Reading> readings);

/// Lux of one lamp at `factor` (RGB) times its power in the file.
double lux_of_lamp(const Reading& reading, size_t lamp, vec3 factor = vec3(1));

}  // namespace lw
