#include "app/session/luminaire.h"

#include <cmath>

#include "photometry/photometry.h"
#include "scene/light.h"

namespace lw {

float share_of_profile(const Scene& scene, const Light& light, float gamma_deg, float c_deg) {
    const float gamma = gamma_deg * lw_pi / 180, c = c_deg * lw_pi / 180;
    const vec3 around = light.across * std::cos(c) + cross(light.across, light.direction) * std::sin(c);
    return SurfaceReader(scene).profile_value(light, light.direction * std::cos(gamma) + around * std::sin(gamma));
}

std::map<size_t, Luminaire> luminaires_of(const Scene& scene, const std::vector<std::string>& photometry) {
    std::map<size_t, Luminaire> luminaires;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (!has_table(scene.lights[i].type)) continue;
        Luminaire& luminaire = luminaires[i];
        luminaire.unit_flux = unit_flux(scene, scene.lights[i]);
        for (const std::string& text : photometry) {
            if (!text.starts_with(scene.light_names[i] + "=")) continue;
            luminaire.file = text.substr(scene.light_names[i].size() + 1);
            luminaire.summary = summary_of(read_photometry(luminaire.file));
        }
    }
    return luminaires;
}

}  // namespace lw
