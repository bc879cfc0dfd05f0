#include "scene/profile.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "scene/content_hash.h"

namespace lw {
namespace {

constexpr uint columns_of_table = 144;  // every 2.5 degrees of C
constexpr uint rows_of_table = 361;     // every 0.5 degrees of gamma
constexpr double pi = 3.14159265358979323846;

std::vector<double> sampled(const Photometry& photometry, uint columns) {
    std::vector<double> candela;
    for (uint column = 0; column < columns; ++column)
        for (uint row = 0; row < rows_of_table; ++row) {
            const double c = 2 * pi * column / columns, gamma = pi * row / (rows_of_table - 1);
            candela.push_back(candela_at(
                photometry, {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)}));
        }
    return candela;
}

/// The lamp's colour at luminance 1.
vec3 chromaticity(vec3 intensity) {
    const float luminance = dot(intensity, vec3(0.2126f, 0.7152f, 0.0722f));
    return luminance > 0 ? intensity / luminance : vec3(1);
}

}  // namespace

void attach_photometry(const Photometry& photometry, Light& light, Scene& scene) {
    const bool round = photometry.type == Photometry::Type::C && photometry.horizontal.size() == 1;
    const uint columns = round ? 1 : columns_of_table;
    const std::vector<double> candela = sampled(photometry, columns);
    const double strongest = *std::max_element(candela.begin(), candela.end());
    const double tilt = std::acos(std::clamp(double(-light.direction.y), -1.0, 1.0)) * 180 / pi;
    light.type = light_profile;
    light.intensity = chromaticity(light.intensity) * float(strongest * tilt_factor(photometry, tilt));
    light.cos_inner = light.cos_outer = 0;
    light.profile = uint(scene.texels.size());
    scene.texels.push_back(columns);
    scene.texels.push_back(rows_of_table);
    for (const double value : candela) scene.texels.push_back(std::bit_cast<uint>(float(value / strongest)));
}

Scene with_photometry(Scene scene, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
        const size_t equals = text.find('=');
        if (equals == std::string::npos) throw Error("--ies " + text + ": write LAMP=FILE");
        const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), text.substr(0, equals));
        std::string names;
        for (const std::string& name : scene.light_names) names += (names.empty() ? "" : ", ") + name;
        if (found == scene.light_names.end())
            throw Error("--ies " + text + ": no lamp of this name; there are: " + names);
        Light& light = scene.lights[size_t(found - scene.light_names.begin())];
        if (light.type == light_mesh || light.type == light_directional)
            throw Error("--ies " + text + ": only a point or spot lamp can have a photometric file");
        attach_photometry(read_photometry(text.substr(equals + 1)), light, scene);
    }
    if (!texts.empty()) scene.content_hash = content_hash(scene);
    return scene;
}

}  // namespace lw
