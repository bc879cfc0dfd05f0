// Lamps with a measured light distribution: a table in the array of texels (shaders/profile.glsl) beside a point.
#pragma once
#include <string>
#include <vector>

#include "photometry/photometry.h"
#include "scene/scene.h"

namespace lw {

/// Gives a lamp that is a point the distribution of a luminaire: it aims along the lamp's direction with C0 towards
/// `across`. Its intensity becomes the file's strongest candela in the lamp's own colour, or, when that is white, in
/// that of the colour temperature the file gives; dimmed for its tilt. The content hash is left to the caller.
void attach_photometry(const Photometry& photometry, Light& light, Scene& scene);

/// Factors by colour that give a lamp the colour of a black body of this many kelvin at its own luminance. Throws Error
/// for a lamp that lacks a colour which that light has.
vec3 filter_to_temperature(vec3 intensity, double kelvin);

/// Linear Rec. 709 of luminance 1 of a black body of this many kelvin, 1,000 to 15,000 (Krystek 1985).
vec3 color_of_temperature(double kelvin);

/// The scene with the files of "LAMP=FILE" texts on its point and spot lamps. Throws Error for an unknown lamp, one
/// that is a mesh or a sun, and a bad file.
Scene with_photometry(Scene scene, const std::vector<std::string>& texts);

}  // namespace lw
