// A reference picture by the path tracer: mean and standard error of each pixel.
#pragma once
#include "image/image.h"
#include "scene/scene.h"
#include "trace/path_tracer.h"

namespace lw {

/// When to stop: after `samples` per pixel, or before when `seconds` have passed or the picture's relative error
/// (root mean square standard error / mean) is below `error`. 0 means no such limit.
struct ReferenceSettings {
    int width = 960, height = 540;
    uint64_t samples = 256;
    double seconds = 0;
    double error = 0;
    bool illuminance = true;  // also trace a second path per sample, which measures lux at the first surface
    uint64_t seed = 1;
    uint64_t caustic_paths = 200'000;  // from the lamps per sample, in scenes with caustics; 0 leaves caustics out
    float caustic_radius = 0;  // m, radius of the kernel for caustics in the first sample; 0: 0.4 % of the scene's size
    const Daylight* daylight = nullptr;  // around the scene; nullptr: darkness
};

struct Reference {
    Image image;  // R G B, error.R error.G error.B (standard errors), depth, normal.XYZ, triangle, illuminance,
                  // error.illuminance
    uint64_t samples = 0;
    double relative_error = 0;
    float caustic_radius = 0;  // m, root mean square over the samples: the blur of caustics; 0 without any
};

/// Throws Error when a picture of this size takes more than `available` bytes; the message says which size would fit.
void check_reference_fits(const ReferenceSettings& settings, uint64_t available);

/// Renders through pixel centres, as the gather does, so that pictures can be compared pixel by pixel.
Reference render_reference(const Scene& scene, const RayCaster& caster, const Camera& camera,
                           const std::vector<vec3>& powers, const ReferenceSettings& settings);

}  // namespace lw
