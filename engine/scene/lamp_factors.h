// Factors that dim and tint the lamps: what each one's intensity is multiplied by, per lamp of the scene and channel.
// They come from the options of the programs and from the ambiances beside the scene.
#pragma once
#include "scene/ambiance.h"

namespace lw {

/// The index of a lamp. Throws Error("WHERE; there are: NAMES") for an unknown one.
size_t find_lamp(const Scene& scene, const std::string& name, const std::string& where);

/// Factor per lamp and colour from "NAME=FACTOR" texts, 1 where none is given, or "NAME=FACTOR@KELVIN", which gives the
/// lamp the colour of a black body too. Throws Error for an unknown lamp, a factor that is not a finite number >= 0, or
/// a temperature outside 1,000 to 15,000 K.
std::vector<vec3> parse_factors(const Scene& scene, const std::vector<std::string>& texts);

/// What the setting of a lamp of this intensity multiplies it by, by colour. Throws Error as filter_to_temperature().
vec3 factor_of(const LampSetting& setting, vec3 intensity);

/// One factor per lamp of the scene and channel. Throws Error naming a lamp that the scene does not have.
std::vector<vec3> lamp_factors(const Scene& scene, const Ambiance& ambiance);

/// Factors of the ambiance called `name` of the scene's file (none when empty) times those of "LAMP=FACTOR" texts.
/// Throws Error listing the ambiances, or as lamp_factors() and parse_factors().
std::vector<vec3> chosen_factors(const Scene& scene, const std::string& name, const std::vector<std::string>& powers);

}  // namespace lw
