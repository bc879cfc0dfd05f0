// Sampling of the glTF material: diffuse, GGX reflection and transmission, mirrors, thin sheets, refracting volumes.
// The values come from shaders/bsdf.glsl, so that the path tracer, the photons and the gather share one BSDF.
#pragma once
#include <optional>

#include "base/random.h"
#include "scene/surface.h"

namespace lw {

/// What a path carries from `to_view` on: radiance is gathered (a path from the eye), flux is spread (a photon).
/// They differ where light refracts, by the square of the index, and at bent shading normals (Veach 1997, chapter 5).
enum class Carries { radiance, flux };

/// One sampled continuation of a path.
struct Scatter {
    vec3 direction;  // unit, away from the surface
    vec3 weight;     // BSDF x cosine / pdf, per RGB
    float pdf;       // solid angle, of the lobes that light sampling can evaluate; 0 for specular ones
    bool specular;   // mirror or smooth glass: light sampling does not cover it
    bool straight;   // passed a thin sheet without turning: shadow rays pass there too
    bool narrow;     // by a lobe so narrow that what it throws on other surfaces is nearly as sharp as a caustic
};

/// Samples a direction at `s` for a path that comes from `to_view` (unit, away from the surface). nullopt when
/// absorbed. The estimate is unbiased for eval_bsdf and the mirror and smooth glass lobes it leaves out.
std::optional<Scatter> sample_bsdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, Carries carries,
                                   Rng& rng);

/// Solid-angle pdf with which sample_bsdf picks `to_light` by its non-specular lobes.
float bsdf_pdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, vec3 to_light);

/// Absorption (1/m) of what lies before `s` on a ray along `direction`: the volume's own when its surface is met from
/// inside, else that of the `medium` the path knows of.
vec3 absorption_before(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium);

/// Absorption (1/m) of what lies behind `s` along the direction in which a path leaves it.
vec3 absorption_after(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium);

}  // namespace lw
