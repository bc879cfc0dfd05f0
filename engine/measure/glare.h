// Glare of lamps in a view: the unified glare rating of CIE 117:1995. In: a scene, the place and direction of the eyes.
// Out: luminance (cd/m2), solid angle (sr) and Guth position index of each source, background luminance, UGR.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "trace/path_tracer.h"

namespace lw {

/// A source of glare: a bright region of the field of view.
struct GlareSource {
    uint lamp = 0;
    double luminance = 0;    // cd/m2, mean over the solid angle
    double solid_angle = 0;  // sr
    vec3 direction{0};       // unit, from the eye to the middle of the source
};

/// The term of one source in the sum of the UGR: L^2 omega / p^2, with p its Guth position index for eyes that look
/// along `forward`.
double glare_of(const GlareSource& source, vec3 forward, vec3 up);

/// UGR = 8 log10(0.25 / background x sum), where `sum_of_glare` is the sum of glare_of() and `background` is in cd/m2.
/// Returns -infinity when the sum is 0.
double unified_glare_rating(double sum_of_glare, double background);

/// A rating as text: "19.3", or "none" for -infinity.
std::string rating_text(double rating);

/// The emissive meshes visible from the camera's place in the half space before it, also through thin glass; one source
/// per lamp. Point, spot and directional lamps have no size and are left out. `powers`: RGB power of each lamp;
/// `samples`: points tested per lamp.
std::vector<GlareSource> find_visible_lamps(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                            std::span<const vec3> powers, uint samples = 1024);

/// Background luminance (CIE 117), cd/m2: the illuminance at the eye on the plane that faces forward, without light
/// straight from the lamps, divided by pi. Path traced with `samples` paths.
double background_luminance(const Scene& scene, const RayCaster& caster, const Camera& camera,
                            std::span<const vec3> powers, uint samples = 4096);

}  // namespace lw
