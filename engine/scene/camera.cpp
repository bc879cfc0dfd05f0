#include "scene/camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/profile.h"

namespace lw {
namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

constexpr float max_factor = 1e12f;  // light of the brightest lamps times this stays a float

/// A number, or -1.
float parse_number(const std::string& text) {
    size_t used = 0;
    float number = -1;
    try {
        number = std::stof(text, &used);
    } catch (const std::exception&) {
    }
    return used == text.size() && std::isfinite(number) ? number : -1;
}

/// "FACTOR", "FACTOR@KELVIN" or "FACTOR@KELVINK" of a lamp of this intensity.
vec3 parse_factor(const std::string& text, vec3 intensity) {
    const size_t at = text.find('@');
    const float factor = parse_number(text.substr(0, at));
    if (!(factor >= 0 && factor <= max_factor)) throw Error("the factor must be a number from 0 to 1e12");
    if (at == std::string::npos) return vec3(factor);
    std::string kelvin = text.substr(at + 1);
    if (kelvin.ends_with('K')) kelvin.pop_back();
    const float temperature = parse_number(kelvin);
    if (temperature < 1000 || temperature > 15000) throw Error("the colour temperature must be 1000 to 15000 K");
    return factor * filter_to_temperature(intensity, double(temperature));
}

}  // namespace

const Camera& find_camera(const Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (name.empty() || camera.name == name) return camera;
        names.push_back(camera.name);
    }
    throw Error(scene.path.filename().string() + ": no camera \"" + name + "\"; there are: " + joined(names));
}

vec3 camera_direction(const Camera& camera, float x, float y, int width, int height) {
    const float half = std::tan(0.5f * camera.yfov);
    const float right = (2 * x / float(width) - 1) * half * float(width) / float(height);
    const float up = (1 - 2 * y / float(height)) * half;
    return normalize(camera.rotation * vec3(right, up, -1));
}

CameraRay camera_ray(const Camera& camera, float x, float y, int width, int height) {
    const vec3 direction = camera_direction(camera, x, y, width, height);
    return {camera.position + direction * (camera.near / -dot(direction, camera.rotation[2])), direction};
}

std::vector<vec3> parse_powers(const Scene& scene, const std::vector<std::string>& texts) {
    std::vector<vec3> factors(scene.lights.size(), vec3(1));
    for (const std::string& text : texts) {
        const size_t equals = text.rfind('=');
        if (equals == std::string::npos) throw Error("--power " + text + ": write LIGHT=FACTOR");
        const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), text.substr(0, equals));
        if (found == scene.light_names.end())
            throw Error("--power " + text + ": no lamp of this name; there are: " + joined(scene.light_names));
        const auto lamp = size_t(found - scene.light_names.begin());
        try {
            factors[lamp] = parse_factor(text.substr(equals + 1), scene.lights[lamp].intensity);
        } catch (const Error& e) {
            throw Error("--power " + text + ": " + e.what());
        }
    }
    return factors;
}

}  // namespace lw
