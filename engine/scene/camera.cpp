#include "scene/camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace lw {
namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

float parse_factor(const std::string& text, const std::string& option) {
    size_t used = 0;
    float factor = -1;
    try {
        factor = std::stof(text, &used);
    } catch (const std::exception&) {
    }
    if (used != text.size() || !std::isfinite(factor) || factor < 0)
        throw Error("--power " + option + ": the factor must be a number of at least 0");
    return factor;
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

std::vector<vec3> parse_powers(const Scene& scene, const std::vector<std::string>& texts) {
    std::vector<vec3> factors(scene.lights.size(), vec3(1));
    for (const std::string& text : texts) {
        const size_t equals = text.rfind('=');
        if (equals == std::string::npos) throw Error("--power " + text + ": write LIGHT=FACTOR");
        const auto found = std::find(scene.light_names.begin(), scene.light_names.end(), text.substr(0, equals));
        if (found == scene.light_names.end())
            throw Error("--power " + text + ": no lamp of this name; there are: " + joined(scene.light_names));
        factors[size_t(found - scene.light_names.begin())] = vec3(parse_factor(text.substr(equals + 1), text));
    }
    return factors;
}

}  // namespace lw
