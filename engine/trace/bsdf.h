// Sampling of the glTF material: reflection (diffuse and GGX), mirror, thin and refracting glass.
// The values come from shaders/bsdf.glsl, so that the path tracer, the photons and the gather share one BRDF.
#pragma once
#include <optional>

#include "base/random.h"
#include "scene/surface.h"

namespace lw {

/// One sampled continuation of a path.
struct Scatter {
    vec3 direction;  // unit, away from the surface
    vec3 weight;     // BSDF x cosine / pdf, per RGB
    float pdf;       // solid angle, of the lobes that light sampling can evaluate; 0 for specular ones
    bool specular;   // mirror or transmission: light sampling does not cover it
};

/// Samples a direction at `s` for light or view arriving from `to_view` (unit, away from the surface).
/// nullopt when absorbed. The estimate is unbiased for the BRDF of the specification plus transmission.
std::optional<Scatter> sample_bsdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, Rng& rng);

/// Solid-angle pdf with which sample_bsdf picks `to_light` by its non-specular lobes.
float bsdf_pdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, vec3 to_light);

}  // namespace lw
