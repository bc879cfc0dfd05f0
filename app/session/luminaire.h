// What is known of lamps with a measured light distribution: the table they shine by, and the file it comes from.
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

/// Those of a scene that was loaded with these "LAMP=FILE" texts, by lamp.
std::map<size_t, Luminaire> luminaires_of(const Scene& scene, const std::vector<std::string>& photometry);

/// Share of the strongest intensity at angles from the axis and around it (C), degrees: 1 to 0. The lamp must be a
/// light_profile.
float share_of_profile(const Scene& scene, const Light& light, float gamma_deg, float c_deg);

}  // namespace lw
