// What a sensor says: lux of each lamp and colour at the file's power, so that any ambiance is a weighted sum, and what
// is known of its error. The interval covers the truth in about 90 % of the cases (docs/measuring.md).
#pragma once
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lw {

/// Illuminance by colour, lx: luminance-weighted, so that red, green and blue add up to lux. Powers and filters are
/// factors of the three.
using ChannelLux = vec3;

/// Independent repetitions of the rays of a sensor; their spread is the error of the rays.
constexpr uint repetitions = 8;

/// All at the file's powers, one entry per lamp where nothing else is said.
struct Reading {
    std::vector<ChannelLux> lamps;
    std::vector<ChannelLux> repeated;         // repetition r of lamp l at r * lamps + l
    std::vector<ChannelLux> scatter;          // standard error if the rays were random
    std::vector<ChannelLux> photon_variance;  // lx2
    std::vector<ChannelLux> by_photons;       // what of it the photons of the map say
    std::vector<ChannelLux> blur;             // what the kernel may take off or add to a caustic on the sensor itself
    float kernel_bias = 0;                    // part of by_photons that other kernels may lose or add
    uint rays = 0;
    bool blocked = false;      // inside or right under something
    bool near_border = false;  // is_near_border()
    bool at_lamp = false;      // is_at_lamp()
};

/// One number to sign: lux and half the width of its 90 % interval.
struct Value {
    double lux = 0;
    double half_width = 0;
    double ray_error = 0;     // standard error of the rays, lx
    double photon_error = 0;  // standard error of the photons, their bias included, lx
    double photons = 0;       // effective number of independent photons in the light that photons bring
    std::string doubt;        // why not to trust it, or ""

    double relative() const { return lux > 0 ? half_width / lux : 0; }
};

/// The value with each lamp at `factors[l]` of the file's power, by colour, and `maintenance` of its light left.
Value value_of(const Reading& reading, std::span<const vec3> factors, float maintenance = 1);

/// True when no lamp was found at all.
bool is_dark(const Reading& reading);

/// Throws Error with the number of the sensor when a reading is NaN, infinite or negative.
void check_is_light(std::span<const Reading> readings);

/// Lux of one lamp at `factor` of the file's power.
double lux_of_lamp(const Reading& reading, size_t lamp, vec3 factor = vec3(1));

}  // namespace lw
