// Data to show about lamps with a measured light distribution: the file it comes from and its flux.
#pragma once
#include <map>
#include <string>

#include "scene/scene.h"

namespace lw {

struct Luminaire {
    std::string file;     // "" when the distribution is part of the scene
    std::string summary;  // flux, strongest intensity, light output ratio and colour temperature of the file
    float unit_flux = 0;  // lm per candela of the strongest direction
};

/// The luminaires of a scene that was loaded with these "LAMP=FILE" texts, by the index of the lamp.
std::map<size_t, Luminaire> luminaires_of(const Scene& scene, const std::vector<std::string>& photometry);

/// The intensity of a lamp relative to its strongest, 0 to 1, at `gamma_deg` degrees from its aim and `c_deg` degrees
/// around it (C). The lamp must be a light_profile.
float share_of_profile(const Scene& scene, const Light& light, float gamma_deg, float c_deg);

}  // namespace lw
