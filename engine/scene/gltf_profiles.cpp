#include "scene/gltf_profiles.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_accessor.h"

namespace lw {
namespace {

std::string text_of(const tinygltf::Value& object, const char* key) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

Photometry photometry_of(const GltfFile& file, int index, Scene& scene) {
    const std::string where = "light profile " + std::to_string(index);
    const auto root = file.model.extensions.find("EXT_lights_ies");
    if (root == file.model.extensions.end() || !root->second.Has("lights") || !root->second.Get("lights").IsArray() ||
        index < 0 || size_t(index) >= root->second.Get("lights").ArrayLen())
        file.fail("there is no " + where);
    const tinygltf::Value& profile = root->second.Get("lights").Get(index);
    if (profile.Has("bufferView")) {
        const std::span<const unsigned char> text = read_view(file, index_of(profile, "bufferView", -1), where);
        return parse_photometry(std::string(text.begin(), text.end()), file.name + ": " + where);
    }
    const std::string uri = text_of(profile, "uri");
    if (uri.empty()) file.fail(where + ": has neither uri nor bufferView");
    if (!uri.starts_with("data:")) {
        scene.files.push_back(scene.path.parent_path() / decoded_uri(file, uri));
        return read_photometry(scene.files.back());
    }
    const size_t comma = uri.find(";base64,");
    std::vector<unsigned char> bytes;
    std::string mime;
    const std::string plain = comma == std::string::npos ? "" : "data:application/octet-stream" + uri.substr(comma);
    if (!tinygltf::DecodeDataURI(&bytes, mime, plain, 0, false)) file.fail(where + ": its data: address is not base64");
    return parse_photometry(std::string(bytes.begin(), bytes.end()), file.name + ": " + where);
}

}  // namespace

vec3 across_of(const PlacedNode& at, vec3 direction) {
    const glm::dvec3 axis(direction), x(at.world[0]);
    glm::dvec3 across = x - axis * glm::dot(x, axis);
    if (!(glm::length(across) > 1e-9))
        across = glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
    return vec3(glm::normalize(across));
}

bool is_mirrored(const PlacedNode& at, const Light& light) {
    return glm::dot(glm::dvec3(at.world[1]), glm::cross(glm::dvec3(light.across), glm::dvec3(light.direction))) < 0;
}

void add_profile_light(GltfFile& file, const PlacedNode& at, KnownProfiles& known, Scene& scene) {
    const tinygltf::Node& node = file.model.nodes[at.node];
    const auto* extension = extension_of(node.extensions, "EXT_lights_ies");
    if (!extension) return;
    const std::string where = label("node", at.node, node.name);
    const double multiplier = number_of(*extension, "multiplier", 1);
    if (!(multiplier >= 0 && multiplier < 1e9))
        file.fail(where + ": the multiplier of its light profile is negative or too large");
    glm::dvec3 color(1);
    if (extension->Has("color") && extension->Get("color").ArrayLen() == 3)
        for (int c = 0; c < 3; ++c) color[c] = std::clamp(extension->Get("color").Get(c).GetNumberAsDouble(), 0.0, 1.0);
    Light light{};
    light.position = vec3(glm::dvec3(at.world[3]) - scene.origin);
    if (!(length(glm::dvec3(light.position)) < 2 * max_metres)) file.fail(where + ": the position is too far away");
    const glm::dvec3 aim = -glm::dvec3(at.world[2]);
    light.direction = glm::length(aim) > 0 ? vec3(glm::normalize(aim)) : vec3(0, -1, 0);
    light.across = across_of(at, light.direction);
    const bool mirrored = is_mirrored(at, light);
    const int index = index_of(*extension, "light", -1);
    auto profile = known.find({index, mirrored});
    if (profile == known.end()) {
        const Photometry photometry = photometry_of(file, index, scene);
        profile = known.emplace(std::pair(index, mirrored), add_profile(photometry, mirrored, scene)).first;
    }
    attach_profile(profile->second, light);
    light.intensity *= vec3(color * multiplier);
    if (!(dot(light.intensity, vec3(1)) <= max_strength)) file.fail(where + ": the intensity is larger than 1e15");
    if (mirrored) scene.mirrored_lights.insert(scene.lights.size());
    scene.lights.push_back(light);
    scene.light_names.push_back(node.name.empty() ? "light_" + std::to_string(scene.lights.size()) : node.name);
}

}  // namespace lw
