// Sampling of the glTF material: diffuse, GGX reflection and transmission, mirrors, thin sheets, refracting volumes.
// The values come from shaders/bsdf.glsl, so that the path tracer, the photons and the gather share one BSDF.
#pragma once
#include <optional>

#include "base/random.h"
#include "scene/surface.h"

namespace lw {

/// What a path carries: radiance, for a path from the eye, or flux, for a photon. The weights differ where light
/// refracts, by the square of the index, and where the shading normal is not the geometric one (Veach 1997, chapter 5).
enum class Carries { radiance, flux };

/// A sampled direction in which a path goes on.
struct Scatter {
    vec3 direction;  // unit, away from the surface
    vec3 weight;     // BSDF x cosine / pdf, per RGB
    float pdf;       // per solid angle, over the lobes that light sampling can evaluate; 0 when `specular`
    bool specular;   // mirror or smooth glass: light sampling does not cover it
    bool straight;   // passed a thin sheet without a change of direction, as shadow rays do
    bool narrow;     // by a lobe so narrow that its light on other surfaces is nearly as sharp as a caustic
};

/// Samples a direction at `s` for a path that comes from `to_view` (unit, away from the surface). nullopt when
/// absorbed. The estimate is unbiased for eval_bsdf and the mirror and smooth glass lobes it leaves out.
std::optional<Scatter> sample_bsdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, Carries carries,
                                   Rng& rng);

/// True when the surface has a specular lobe that is no mirror but nearly as sharp (Scatter::narrow).
bool has_narrow_lobe(const Surface& s);

/// True for surfaces whose reflected light final gathering takes to be alike on all sides: all but mirrors, clear glass
/// and smooth metal.
bool reflects_to_all_sides(const SurfaceReader& reader, const Surface& s);

/// Solid-angle pdf with which sample_bsdf picks `to_light` by its non-specular lobes.
float bsdf_pdf(const SurfaceReader& reader, const Surface& s, vec3 to_view, vec3 to_light);

/// Absorption (1/m, per RGB) of the medium that a ray along `direction` crosses before it meets `s`: that of the volume
/// when its surface is met from inside, else `medium`, the absorption that the path was in.
vec3 absorption_before(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium);

/// Absorption (1/m, per RGB) of the medium into which a path leaves `s` along `direction`.
vec3 absorption_after(const SurfaceReader& reader, const Surface& s, vec3 direction, vec3 medium);

}  // namespace lw
