// Ambiances: named sets of lamp powers, kept in SCENE.ambiances.json beside the scene with groups of lamps made by
// hand.
//   { "ambiances": { "Evening": { "Pendant": 0.4, "Desk": { "factor": 1, "kelvin": 2700 },
//                                 "Lounge": { "factor": 1.2, "color": [1, 0.8, 0.6] } } },
//     "groups": { "Ceiling": ["Pendant", "Spot"] },
//     "photometry": { "Spot": "files/downlight.ies" } }
// A factor multiplies the power the lamp has in the scene file; a color is a filter, linear Rec.709, 1 passes all;
// kelvin gives the lamp the colour of a black body at its own luminance (scene/profile.h).
// Lamps that an ambiance does not name keep the power of the scene file. Photometric files are beside the JSON file.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lw {

struct LampSetting {
    float factor = 1;
    vec3 color{1};
    float kelvin = 0;  // 0: the lamp's own colour
    bool operator==(const LampSetting&) const = default;
};

using Ambiance = std::map<std::string, LampSetting>;  // by the lamp's name

struct LampBook {
    std::map<std::string, Ambiance> ambiances;
    std::map<std::string, std::vector<std::string>> groups;  // names of lamps
    std::map<std::string, std::string> photometry;           // lamp -> file, relative to the folder of the scene
};

/// The default file of a scene's ambiances: SCENE.ambiances.json beside SCENE.glb.
std::filesystem::path default_ambiances_path(const std::filesystem::path& scene);

/// Reads the file; the book is empty when there is no such file. Throws Error naming file, ambiance and lamp for
/// anything malformed.
LampBook load_lamp_book(const std::filesystem::path& path);

/// Writes the book as JSON. Throws Error naming the file when it cannot be written.
void save_lamp_book(const std::filesystem::path& path, const LampBook& book);

/// The factor, per RGB channel, by which a setting multiplies the intensity of a lamp. `intensity` is the lamp's own,
/// needed for the colour of a temperature. Throws Error as filter_to_temperature().
vec3 factor_of(const LampSetting& setting, vec3 intensity);

/// The factors of an ambiance: one RGB per lamp of the scene, 1 for lamps it does not name. Throws Error naming a lamp
/// that the scene does not have.
std::vector<vec3> light_factors(const Scene& scene, const Ambiance& ambiance);

/// The factors that a command line asks for, one RGB per lamp: those of the ambiance `name` from the scene's default
/// file (all 1 when `name` is empty), times those of the "LAMP=FACTOR" texts `powers`. Throws Error listing the
/// ambiances when there is none of this name, or as light_factors() and parse_powers().
std::vector<vec3> chosen_factors(const Scene& scene, const std::string& name, const std::vector<std::string>& powers);

}  // namespace lw
