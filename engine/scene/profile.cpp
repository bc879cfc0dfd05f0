#include "scene/profile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "base/error.h"
#include "scene/ambiance.h"
#include "scene/content_hash.h"
#include "scene/lamp_factors.h"
#include "scene/profile_table.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

void tell(const std::string& what, Scene& scene) {
    if (std::find(scene.warnings.begin(), scene.warnings.end(), what) == scene.warnings.end())
        scene.warnings.push_back(what);
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

Profile add_profile(const Photometry& photometry, bool mirrored, Scene& scene) {
    const ProfileTable table = profile_table(photometry, mirrored);
    const double strongest = *std::max_element(table.candela.begin(), table.candela.end());
    const Profile profile{photometry, strongest, uint(scene.texels.size())};
    scene.texels.push_back(table.columns);
    scene.texels.push_back(table.rows);
    for (const double value : table.candela) scene.texels.push_back(std::bit_cast<uint>(float(value / strongest)));
    for (const std::string& note : photometry.notes) tell(note, scene);
    if (!table.follows) tell(photometry.file + ": its beam is narrower than the finest table can follow", scene);
    if (!photometry.tilt_file.empty()) scene.files.push_back(photometry.tilt_file);
    return profile;
}

void attach_profile(const Profile& profile, Light& light) {
    const double tilt = std::acos(std::clamp(double(-light.direction.y), -1.0, 1.0)) * 180 / pi;
    const double strongest = profile.strongest * tilt_factor(profile.photometry, tilt);
    light.type = light_profile;
    light.intensity = chromaticity(light.intensity, profile.photometry) * float(strongest);
    light.cos_inner = light.cos_outer = 0;
    light.profile = profile.first_word;
}

Scene with_photometry(Scene scene, const std::vector<std::string>& texts) {
    std::map<std::pair<std::filesystem::path, bool>, Profile> known;
    for (const std::string& text : texts) {
        const size_t equals = text.find('=');
        if (equals == std::string::npos) throw Error("--ies " + text + ": write LAMP=FILE");
        const size_t lamp = find_lamp(scene, text.substr(0, equals), "--ies " + text + ": no lamp of this name");
        Light& light = scene.lights[lamp];
        if (!is_at_point(light.type))
            throw Error("--ies " + text + ": only a point or spot lamp can have a photometric file");
        const std::filesystem::path file = text.substr(equals + 1);
        const bool mirrored = scene.mirrored_lights.contains(lamp);
        auto profile = known.find({file, mirrored});
        if (profile == known.end())
            profile =
                known.emplace(std::pair(file, mirrored), add_profile(read_photometry(file), mirrored, scene)).first;
        attach_profile(profile->second, light);
        scene.files.push_back(file);
    }
    if (!texts.empty()) scene.content_hash = content_hash(scene);
    return scene;
}

}  // namespace lw
