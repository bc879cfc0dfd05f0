#include "scene/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "scene/gltf_profiles.h"
#include "scene/light.h"
#include "scene/triangle.h"
#include "shaders/color.h"

namespace lw {
namespace {

Light punctual_light(const GltfFile& file, const tinygltf::Light& source, const PlacedNode& at,
                     const std::string& where, const Scene& scene) {
    Light light{};
    if (source.type == "point")
        light.type = light_point;
    else if (source.type == "spot")
        light.type = light_spot;
    else if (source.type == "directional")
        light.type = light_directional;
    else
        file.fail(where + ": unknown type \"" + source.type + "\"");
    const std::vector<double>& c = source.color;
    const glm::dvec3 color = c.size() >= 3 ? glm::dvec3(c[0], c[1], c[2]) : glm::dvec3(1);
    light.intensity = vec3(color * source.intensity);
    light.position = vec3(glm::dvec3(at.world[3]) - scene.origin);
    light.direction = unit_or(-glm::dvec3(at.world[2]), vec3(0, -1, 0));
    light.across = across_of(at, light.direction);
    const double outer = std::clamp(source.spot.outerConeAngle, 1e-3, double(lw_pi) / 2);
    light.cos_outer = float(std::cos(outer));
    light.cos_inner = float(std::cos(std::clamp(source.spot.innerConeAngle, 0.0, outer)));
    if (!std::isfinite(dot(light.intensity, vec3(1)))) file.fail(where + ": the intensity is not finite");
    if (dot(light.intensity, vec3(1)) > max_strength) file.fail(where + ": the intensity is larger than 1e15");
    if (!(length(glm::dvec3(light.position)) < 2 * max_metres)) file.fail(where + ": the position is too far away");
    return light;
}

/// The name of the parent node, or "" at the root.
std::string group_of(const GltfFile& file, const PlacedNode& at) {
    return at.parent < 0 ? "" : name_of(file, size_t(at.parent), "group");
}

void add_punctual(const GltfFile& file, const PlacedNode& at, Scene& scene) {
    const tinygltf::Node& node = file.model.nodes[at.node];
    const auto* extension = extension_of(node.extensions, "KHR_lights_punctual");
    if (!extension) return;
    const int index = index_of(*extension, "light", -1);
    if (index < 0 || size_t(index) >= file.model.lights.size())
        file.fail(label("node", at.node, node.name) + ": there is no light " + std::to_string(index));
    const tinygltf::Light& source = file.model.lights[size_t(index)];
    const Light light = punctual_light(file, source, at, label("light", size_t(index), source.name), scene);
    if (is_mirrored(at, light)) scene.mirrored_lights.insert(scene.lights.size());
    scene.lights.push_back(light);
    const std::string& name = node.name.empty() ? source.name : node.name;
    scene.light_names.push_back(name.empty() ? "light_" + std::to_string(scene.lights.size()) : name);
    scene.light_groups.push_back(group_of(file, at));
}

/// Adds a triangle to a mesh light: its area, and its area-weighted position and direction to the sums `moment` and
/// `facing`.
void add_emitter(uint triangle, const Scene& scene, Light& light, glm::dvec3& moment, glm::dvec3& facing) {
    const auto corners = triangle_corners(scene, triangle);
    const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
    const glm::dvec3 normal = edge_product(a, b, c) * 0.5;
    const double area = glm::length(normal);
    const bool both_sides = (scene.material_of(triangle).flags & material_double_sided) != 0;
    light.area += float(both_sides ? 2 * area : area);
    moment += (a + b + c) / 3.0 * area;
    facing += normal;
    light.emitter_count++;
}

void add_mesh_light(const std::string& name, const std::vector<size_t>& objects,
                    const std::vector<uint>& first_triangle, Scene& scene) {
    Light light{};
    light.type = light_mesh;
    light.first_emitter = uint(scene.emitters.size());
    glm::dvec3 moment(0), facing(0);
    double one_sided = 0;
    for (size_t object : objects) {
        light.intensity = glm::max(light.intensity, scene.materials[scene.objects[object].material].emissive);
        scene.objects[object].light = int(scene.lights.size());
        for (uint t = first_triangle[object]; t < first_triangle[object + 1]; ++t) {
            const glm::dvec3 before = facing;
            add_emitter(t, scene, light, moment, facing);
            one_sided += glm::length(facing - before);
            scene.emitters.push_back({t, float(one_sided)});
        }
    }
    light.position =
        one_sided > 0 ? vec3(moment / one_sided) : scene.positions[scene.triangles[first_triangle[objects[0]]].x];
    light.direction = unit_or(facing, vec3(0, -1, 0));
    scene.lights.push_back(light);
    scene.light_names.push_back(name);
}

void add_mesh_lights(const GltfFile& file, const std::vector<PlacedNode>& nodes,
                     const std::vector<size_t>& object_nodes, Scene& scene) {
    std::map<size_t, std::string> groups;
    for (const PlacedNode& at : nodes) groups[at.node] = group_of(file, at);
    std::vector<uint> first_triangle(scene.objects.size() + 1, uint(scene.triangles.size()));
    for (size_t t = scene.triangles.size(); t-- > 0;) first_triangle[scene.triangle_objects[t]] = uint(t);
    for (size_t object = 0; object < object_nodes.size();) {
        std::vector<size_t> emissive;
        const size_t node = object_nodes[object];
        const std::string name = scene.object_names[object];
        for (; object < object_nodes.size() && object_nodes[object] == node; ++object) {
            const vec3 emission = scene.materials[scene.objects[object].material].emissive;
            if (std::max({emission.x, emission.y, emission.z}) > 0) emissive.push_back(object);
        }
        if (emissive.empty()) continue;
        add_mesh_light(name, emissive, first_triangle, scene);
        scene.light_groups.push_back(groups[node]);
    }
}

void warn_if_not_photometric(GltfFile& file, const Scene& scene) {
    double flux = 0;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        flux += precise_luminance(light.intensity) * double(unit_flux(scene, light));
        if (precise_luminance(light.intensity) <= max_usual_intensity(light.type)) continue;
        char text[64];
        std::snprintf(text, sizeof text, "%.3g %s", precise_luminance(light.intensity), unit_of(light.type));
        file.warn("the lamp \"" + scene.light_names[i] + "\" has " + text +
                  "; strengths are read as candela, lux and cd/m2 - is the file photometric?");
        return;
    }
    if (flux < 1)
        file.warn(
            "all lamps together give less than 1 lm; strengths are read as candela, lux and cd/m2 - is the file "
            "photometric?");
}

/// Colours of lights are factors from 0 to 1 (KHR_lights_punctual).
void warn_of_large_colors(GltfFile& file) {
    for (size_t i = 0; i < file.model.lights.size(); ++i) {
        const tinygltf::Light& light = file.model.lights[i];
        if (std::any_of(light.color.begin(), light.color.end(), [](double channel) { return channel > 1; }))
            file.warn(
                label("light", i, light.name) +
                ": its colour is larger than 1 and makes the lamp brighter; are its channels given from 0 to 255?");
    }
}

}  // namespace

void make_unique(std::vector<std::string>& names) {
    std::set<std::string> taken;
    const std::set<std::string> given(names.begin(), names.end());
    for (std::string& name : names) {
        const std::string base = name;
        for (int n = 2; taken.contains(name) || (name != base && given.contains(name)); ++n)
            name = base + "_" + std::to_string(n);
        taken.insert(name);
    }
}

void load_lights(GltfFile& file, const std::vector<PlacedNode>& nodes, const std::vector<size_t>& object_nodes,
                 Scene& scene) {
    KnownProfiles known;
    for (const PlacedNode& at : nodes) {
        add_punctual(file, at, scene);
        add_profile_light(file, at, known, scene);
    }
    add_mesh_lights(file, nodes, object_nodes, scene);
    make_unique(scene.light_names);
    warn_of_large_colors(file);
    if (!scene.lights.empty()) warn_if_not_photometric(file, scene);
}

}  // namespace lw
