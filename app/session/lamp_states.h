// The state of every lamp as the user set it: dimmers, switches, solo, filters; and the factors that follow from it.
#pragma once
#include "scene/ambiance.h"

namespace lw {

struct LampState {
    float dimmer = 1;  // 0 to 2
    bool on = true;
    bool solo = false;  // when any lamp has this, only those that have it are lit
    vec3 color{1};      // filter, linear Rec.709
};

using LampStates = std::vector<LampState>;  // one per lamp of the scene

/// The RGB factor of each lamp, by which its power in the file is multiplied.
std::vector<vec3> factors_of(const LampStates& lamps);

/// The states as an ambiance, by the names of the lamps. Lamps at the power of the file are left out.
Ambiance ambiance_of(const Scene& scene, const LampStates& lamps);

/// States with the settings of an ambiance. Names of lamps that the scene does not have are appended to `missing`.
LampStates with_ambiance(const Scene& scene, const Ambiance& ambiance, std::vector<std::string>& missing);

/// The factors `from` (t = 0) to `to` (t = 1), blended linearly.
std::vector<vec3> mixed(const std::vector<vec3>& from, const std::vector<vec3>& to, float t);

/// Text of a lamp's power in its own unit at a dimmer: "95.49 cd, 1200 lm", "250 cd/m2, 283 lm", "10000 lx".
/// `unit_flux`: lm per unit intensity, as unit_flux() of scene/light.h gives it.
std::string power_text(const Light& light, float dimmer, float unit_flux);

}  // namespace lw
