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

/// The factor, per RGB channel, by which a setting multiplies the intensity of a lamp. `intensity` is the lamp's own,
/// needed for the colour of a temperature. Throws Error as filter_to_temperature().
vec3 factor_of(const LampSetting& setting, vec3 intensity);

/// The factors of an ambiance: one RGB per lamp of the scene, 1 for lamps it does not name. Throws Error naming a lamp
/// that the scene does not have.
std::vector<vec3> lamp_factors(const Scene& scene, const Ambiance& ambiance);

/// The factors that a command line asks for, one RGB per lamp: those of the ambiance `name` from the scene's default
/// file (all 1 when `name` is empty), times those of the "LAMP=FACTOR" texts `powers`. Throws Error listing the
/// ambiances when there is none of this name, or as lamp_factors() and parse_factors().
std::vector<vec3> chosen_factors(const Scene& scene, const std::string& name, const std::vector<std::string>& powers);

}  // namespace lw
