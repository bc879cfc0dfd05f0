// Lamps with a measured light distribution: a point lamp with a table of intensities, which lies in the scene's array
// of texels (shaders/profile.glsl).
#pragma once
#include <string>
#include <vector>

#include "photometry/photometry.h"
#include "scene/scene.h"

namespace lw {

/// A light distribution among the texels of a scene, for any number of lamps.
struct Profile {
    Photometry photometry;
    double strongest;  // cd of a table entry of 1
    uint first_word;   // of the table
};

/// Adds the table of a file to the scene, and the notes of the file to its warnings. With `mirrored`, C grows in the
/// other direction. The caller renews scene.content_hash.
Profile add_profile(const Photometry& photometry, bool mirrored, Scene& scene);

/// Gives a point or spot lamp the distribution of a luminaire, which aims along light.direction with plane C0 towards
/// light.across. The lamp's intensity becomes the largest candela of the file, times the factor for its tilt. Its
/// colour stays; a white lamp gets the colour temperature that the file states.
void attach_profile(const Profile& profile, Light& light);

/// RGB factors that give a lamp of this intensity the colour of a black body at `kelvin` and keep its luminance. Throws
/// Error when the lamp emits nothing in a channel that the black body needs.
vec3 filter_to_temperature(vec3 intensity, double kelvin);

/// The colour of a black body at `kelvin` (1,000 to 15,000) as linear Rec. 709 of luminance 1 (Krystek 1985).
vec3 color_of_temperature(double kelvin);

/// Attaches photometric files to point and spot lamps, as the "LAMP=FILE" texts say, and returns the scene. Throws
/// Error for an unknown lamp, a mesh lamp or sun, and a bad file.
Scene with_photometry(Scene scene, const std::vector<std::string>& texts);

}  // namespace lw
