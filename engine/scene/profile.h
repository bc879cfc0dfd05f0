// Lamps with a measured light distribution: a point lamp with a table of intensities, which lies in the scene's array
// of texels (shaders/profile.glsl).
#pragma once
#include <string>
#include <vector>

#include "photometry/photometry.h"
#include "scene/scene.h"

namespace lw {

/// Gives a point or spot lamp the distribution of a luminaire, which aims along light.direction with plane C0 towards
/// light.across. The lamp's intensity becomes the largest candela of the file, times the factor for its tilt. Its
/// colour stays; a white lamp gets the colour temperature that the file states. The caller renews scene.content_hash.
void attach_photometry(const Photometry& photometry, Light& light, Scene& scene);

/// RGB factors that give a lamp of this intensity the colour of a black body at `kelvin` and keep its luminance. Throws
/// Error when the lamp emits nothing in a channel that the black body needs.
vec3 filter_to_temperature(vec3 intensity, double kelvin);

/// The colour of a black body at `kelvin` (1,000 to 15,000) as linear Rec. 709 of luminance 1 (Krystek 1985).
vec3 color_of_temperature(double kelvin);

/// Attaches photometric files to point and spot lamps, as the "LAMP=FILE" texts say, and returns the scene. Throws
/// Error for an unknown lamp, a mesh lamp or sun, and a bad file.
Scene with_photometry(Scene scene, const std::vector<std::string>& texts);

}  // namespace lw
