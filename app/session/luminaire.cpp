#include "app/session/luminaire.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "photometry/photometry.h"
#include "scene/surface.h"

namespace lw {
namespace {

/// The flux of a lamp for 1 cd in its strongest direction, lm: its relative intensity integrated over the sphere in
/// steps of one degree.
float unit_flux_of(const Scene& scene, const Light& light) {
    constexpr int columns = 72;
    double sum = 0;
    for (int g = 0; g < 180; ++g) {
        const double band = std::cos(double(g) * double(lw_pi) / 180) - std::cos(double(g + 1) * double(lw_pi) / 180);
        for (int c = 0; c < columns; ++c)
            sum += 2 * double(lw_pi) / columns * band *
                   double(share_of_profile(scene, light, float(g) + 0.5f, 360.0f * float(c) / columns));
    }
    return float(sum);
}

}  // namespace

float share_of_profile(const Scene& scene, const Light& light, float gamma_deg, float c_deg) {
    const uint columns = scene.texels[light.profile], rows = scene.texels[light.profile + 1];
    const auto entry = [&](uint column, uint row) {
        return std::bit_cast<float>(
            scene.texels[light.profile + 2 + column % columns * rows + std::min(row, rows - 1)]);
    };
    const float turns = c_deg / 360, column = (turns - std::floor(turns)) * float(columns);
    const float row = std::clamp(gamma_deg / 180, 0.0f, 1.0f) * float(rows - 1);
    const uint i = uint(column), j = uint(row);
    const float low = mix(entry(i, j), entry(i + 1, j), column - float(i));
    const float high = mix(entry(i, j + 1), entry(i + 1, j + 1), column - float(i));
    return mix(low, high, row - float(j));
}

std::map<size_t, Luminaire> luminaires_of(const Scene& scene, const std::vector<std::string>& photometry) {
    std::map<size_t, Luminaire> luminaires;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (scene.lights[i].type != light_profile) continue;
        Luminaire& luminaire = luminaires[i];
        luminaire.unit_flux = unit_flux_of(scene, scene.lights[i]);
        for (const std::string& text : photometry) {
            if (!text.starts_with(scene.light_names[i] + "=")) continue;
            luminaire.file = text.substr(scene.light_names[i].size() + 1);
            luminaire.summary = summary_of(read_photometry(luminaire.file));
        }
    }
    return luminaires;
}

}  // namespace lw
