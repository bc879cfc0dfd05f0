#include "scene/profile.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "scene/ambiance.h"
#include "scene/content_hash.h"
#include "scene/lamp_factors.h"
#include "shaders/color.h"

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
vec3 chromaticity(vec3 intensity, const Photometry& photometry) {
    const float strength = luminance(intensity);
    const vec3 own = strength > 0 ? intensity / strength : vec3(1);
    const bool white = length(own - vec3(1)) < 1e-3f;
    return white && photometry.color_temperature > 0 ? color_of_temperature(photometry.color_temperature) : own;
}

}  // namespace

vec3 color_of_temperature(double kelvin) {
    const double t = std::clamp(kelvin, 1000.0, 15000.0);
    const double u =
        (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    const double v =
        (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    const double x = 3 * u / (2 * u - 8 * v + 4), y = 2 * v / (2 * u - 8 * v + 4);
    const glm::dvec3 xyz(x / y, 1, (1 - x - y) / y);
    const glm::dvec3 rgb(glm::dot(xyz, {3.2404542, -1.5371385, -0.4985314}),
                         glm::dot(xyz, {-0.9692660, 1.8760108, 0.0415560}),
                         glm::dot(xyz, {0.0556434, -0.2040259, 1.0572252}));
    const vec3 visible = max(vec3(rgb), vec3(0));
    return visible / luminance(visible);
}

vec3 filter_to_temperature(vec3 intensity, double kelvin) {
    const vec3 wanted = color_of_temperature(kelvin) * luminance(intensity);
    vec3 filter(0);
    for (int c = 0; c < 3; ++c) {
        if (wanted[c] > 0 && !(intensity[c] > 0)) throw Error("the lamp's own light lacks a colour to be filtered");
        if (wanted[c] > 0) filter[c] = wanted[c] / intensity[c];
    }
    return filter;
}

void attach_photometry(const Photometry& photometry, Light& light, Scene& scene) {
    const bool round = photometry.type == Photometry::Type::C && photometry.horizontal.size() == 1;
    const uint columns = round ? 1 : columns_of_table;
    const std::vector<double> candela = sampled(photometry, columns);
    const double strongest = *std::max_element(candela.begin(), candela.end());
    const double tilt = std::acos(std::clamp(double(-light.direction.y), -1.0, 1.0)) * 180 / pi;
    light.type = light_profile;
    light.intensity = chromaticity(light.intensity, photometry) * float(strongest * tilt_factor(photometry, tilt));
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
        const size_t lamp = find_lamp(scene, text.substr(0, equals), "--ies " + text + ": no lamp of this name");
        Light& light = scene.lights[lamp];
        if (!is_at_point(light.type))
            throw Error("--ies " + text + ": only a point or spot lamp can have a photometric file");
        const std::filesystem::path file = text.substr(equals + 1);
        attach_photometry(read_photometry(file), light, scene);
        scene.files.push_back(file);
    }
    if (!texts.empty()) scene.content_hash = content_hash(scene);
    return scene;
}

}  // namespace lw
