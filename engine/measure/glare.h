// Glare of lamps in a view: the unified glare rating of CIE 117:1995. In: a scene, the place and direction of the eyes.
// Out: luminance (cd/m2), solid angle (sr) and Guth position index of each source, background luminance, UGR.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "trace/path_tracer.h"

namespace lw {

/// Something bright in the field of view.
struct GlareSource {
    uint lamp = 0;
    double luminance = 0;    // cd/m2, mean over the solid angle
    double solid_angle = 0;  // sr
    vec3 direction{0};       // unit, from the eye to its middle
};

/// L2 omega / p2 of one source, the summand of the UGR.
double glare_of(const GlareSource& source, vec3 forward, vec3 up);

/// UGR = 8 lg(0.25 / background x sum), background in cd/m2; -infinity without glare.
double unified_glare_rating(double sum_of_glare, double background);

/// "19.3", or "none" without glare.
std::string rating_text(double rating);

/// The emissive meshes that the eye of the camera sees, anywhere before it, through thin glass too; one source per
/// lamp. Punctual lamps have no size and are left out. `samples` points are looked at per lamp.
std::vector<GlareSource> find_visible_lamps(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                            std::span<const vec3> powers, uint samples = 1024);

/// Background luminance (CIE 117): vertical illuminance at the eye, without the light that comes straight from the
/// lamps, over pi. Path traced with `samples` paths.
double background_luminance(const Scene& scene, const RayCaster& caster, const Camera& camera,
                            std::span<const vec3> powers, uint samples = 4096);

}  // namespace lw
