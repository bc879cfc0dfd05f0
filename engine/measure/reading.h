// What a sensor says: lux of each lamp at unit power, so that any ambiance is a weighted sum, and what is known of its
// error. The interval covers the truth in about 90 % of the cases (docs/measuring.md).
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lw {

/// Independent repetitions of the rays of a sensor; their spread is the error of the rays.
constexpr uint repetitions = 8;

/// Linear in the powers of the lamps. Lux "at the file's power" is luminance-weighted, with the lamp's own intensity.
struct Reading {
    std::vector<vec3> lamps;             // lx per unit intensity and RGB, per lamp
    std::vector<float> repeated;         // lx at the file's power: repetition r of lamp l at r * lamps + l
    std::vector<float> scatter;          // lx2 at the file's power, per lamp: variance if the rays were random
    std::vector<float> photon_variance;  // lx2 at the file's power, per lamp
    std::vector<float> indirect;         // lx at the file's power, per lamp
    std::vector<float> by_photons;       // lx at the file's power, per lamp: what of it the photons of the map say
    std::vector<float> photon_map;       // lx at the file's power, per lamp: estimate from the photons on the surface
    float kernel_bias = 0;               // part of by_photons that kernels may lose or add
    float photons = 0;                   // effective number of photons in the reflected light
    uint rays = 0;
    bool blocked = false;     // inside or right under something
    bool on_surface = false;  // whether photon_map is known: within 2 mm of a surface, in front of it
};

/// One number to sign: lux and half the width of its 90 % interval.
struct Value {
    double lux = 0;
    double half_width = 0;
    double ray_error = 0;     // standard error of the rays, lx
    double photon_error = 0;  // standard error of the photons, their bias included, lx
    std::string doubt;        // why not to trust it, or ""

    double relative() const { return lux > 0 ? half_width / lux : 0; }
};

/// The value with each lamp at `factors[l]` of the file's power and `maintenance` of its light left.
Value value_of(const Reading& reading, const Scene& scene, const std::vector<float>& factors, float maintenance = 1);

/// What the photons on the surface say, with exact direct light unless the map holds it: an estimator of its own beside
/// the value. 0 off surfaces.
double photon_map_lux(const Reading& reading, const std::vector<float>& factors, float maintenance = 1);

/// Lux of one lamp at the file's power.
double lux_of_lamp(const Reading& reading, const Scene& scene, size_t lamp);

}  // namespace lw
