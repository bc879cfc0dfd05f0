#include "lab_scene.h"

#include <cmath>

#include "scene/content_hash.h"
#include "scene/gltf_materials.h"
#include "scene/profile.h"

namespace lw {

Light& LabScene::add_light(LightType type, const std::string& name) {
    Light light{};
    light.type = type;
    light.direction = vec3(0, -1, 0);
    scene_.lights.push_back(light);
    scene_.light_names.push_back(name);
    return scene_.lights.back();
}

void LabScene::begin_object(const std::string& name, float albedo, float radiance) {
    Material material = default_material();
    material.base_color = vec3(albedo);
    material.metallic = material.specular = 0;
    material.emissive = vec3(radiance);
    if (radiance > 0) {
        Light& light = add_light(light_mesh, name);
        light.intensity = vec3(radiance);
        light.first_emitter = uint(scene_.emitters.size());
    }
    scene_.objects.push_back({uint(scene_.materials.size()), radiance > 0 ? int(scene_.lights.size()) - 1 : -1});
    scene_.object_names.push_back(name);
    scene_.materials.push_back(material);
    scene_.material_names.push_back(name);
}

void LabScene::add_triangle(vec3 a, vec3 b, vec3 c) {
    const vec3 product = edge_product(a, b, c);
    if (length(product) < 1e-12f) return;
    const auto first = uint(scene_.positions.size());
    for (const vec3 p : {a, b, c}) {
        scene_.positions.push_back(p);
        scene_.normals.push_back(normalize(product));
    }
    scene_.triangles.push_back({first, first + 1, first + 2});
    scene_.triangle_objects.push_back(uint(scene_.objects.size() - 1));
    const int lamp = scene_.objects.back().light;
    if (lamp < 0) return;
    Light& light = scene_.lights[size_t(lamp)];
    light.area += 0.5f * length(product);
    light.emitter_count++;
    light.position = a;
    light.direction = normalize(product);
    scene_.emitters.push_back({uint(scene_.triangles.size() - 1), light.area});
}

void LabScene::add_rectangle(const std::string& name, vec3 corner, vec3 u, vec3 v, float albedo, float radiance) {
    begin_object(name, albedo, radiance);
    add_triangle(corner, corner + u, corner + u + v);
    add_triangle(corner, corner + u + v, corner + v);
}

void LabScene::add_room(vec3 low, vec3 high, float albedo, float radiance) {
    const vec3 size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    add_rectangle("floor", low, z, x, albedo, radiance);
    add_rectangle("ceiling", low + y, x, z, albedo, radiance);
    add_rectangle("west", low, y, z, albedo, radiance);
    add_rectangle("east", low + x, z, y, albedo, radiance);
    add_rectangle("north", low, x, y, albedo, radiance);
    add_rectangle("south", low + z, y, x, albedo, radiance);
}

void LabScene::add_sphere(vec3 centre, float radius, uint rings, float albedo) {
    begin_object("sphere", albedo, 0);
    const auto point = [&](uint i, uint j) {
        const float phi = lw_pi * float(i) / float(rings), theta = lw_pi * float(j) / float(rings);
        return centre +
               radius * vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    for (uint j = 0; j < rings; ++j)
        for (uint i = 0; i < 2 * rings; ++i) {
            add_triangle(point(i, j), point(i + 1, j), point(i + 1, j + 1));
            add_triangle(point(i, j), point(i + 1, j + 1), point(i, j + 1));
        }
}

void LabScene::add_point(vec3 position, float candela) {
    Light& light = add_light(light_point, "point" + std::to_string(scene_.lights.size()));
    light.position = position;
    light.intensity = vec3(candela);
}

void LabScene::add_spot(vec3 position, vec3 direction, float candela, float inner_deg, float outer_deg) {
    Light& light = add_light(light_spot, "spot" + std::to_string(scene_.lights.size()));
    light.position = position;
    light.direction = normalize(direction);
    light.intensity = vec3(candela);
    light.cos_inner = std::cos(glm::radians(inner_deg));
    light.cos_outer = std::cos(glm::radians(outer_deg));
}

void LabScene::add_luminaire(vec3 position, vec3 direction, vec3 across, const Photometry& photometry) {
    Light& light = add_light(light_profile, "luminaire" + std::to_string(scene_.lights.size()));
    light.position = position;
    light.direction = normalize(direction);
    light.across = normalize(across);
    light.intensity = vec3(1);
    attach_profile(add_profile(photometry, false, scene_), light);
}

void LabScene::add_sun(vec3 direction, float lux) {
    Light& light = add_light(light_directional, "sun");
    light.direction = normalize(direction);
    light.intensity = vec3(lux);
}

Scene LabScene::finish() {
    scene_.path = "lab";
    scene_.cameras = {Camera{}};
    scene_.bounds = {scene_.positions[0], scene_.positions[0]};
    for (const vec3& p : scene_.positions) {
        scene_.bounds[0] = min(scene_.bounds[0], p);
        scene_.bounds[1] = max(scene_.bounds[1], p);
    }
    scene_.content_hash = content_hash(scene_);
    return scene_;
}

}  // namespace lw
