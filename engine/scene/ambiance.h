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

struct LampPresets {
    std::map<std::string, Ambiance> ambiances;
    std::map<std::string, std::vector<std::string>> groups;  // names of lamps
    std::map<std::string, std::string> photometry;           // lamp -> file, relative to the folder of the scene
};

/// The default file of a scene's ambiances: SCENE.ambiances.json beside SCENE.glb.
std::filesystem::path default_ambiances_path(const std::filesystem::path& scene);

/// Reads the file; the presets is empty when there is no such file. Throws Error naming file, ambiance and lamp for
/// anything malformed.
LampPresets load_lamp_presets(const std::filesystem::path& path);

/// Writes the presets as JSON. Throws Error naming the file when it cannot be written.
void save_lamp_presets(const std::filesystem::path& path, const LampPresets& presets);

}  // namespace lw
