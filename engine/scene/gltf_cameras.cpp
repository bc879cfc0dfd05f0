#include "scene/gltf_cameras.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_lights.h"

namespace lw {
namespace {

constexpr float eye_height = 1.65f;  // m above the floor

/// Columns right, up, back: orthonormal and right-handed whatever the node's scale, shear or mirroring.
mat3 rotation_of(const glm::dmat4& world) {
    const auto unit_or = [](glm::dvec3 v, glm::dvec3 otherwise) {
        return glm::length(v) > 1e-12 && std::isfinite(glm::length(v)) ? glm::normalize(v) : otherwise;
    };
    const glm::dvec3 back = unit_or(world[2], glm::dvec3(0, 0, 1));
    const glm::dvec3 spare = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    const glm::dvec3 right =
        unit_or(glm::cross(glm::dvec3(world[1]), back), unit_or(glm::cross(spare, back), glm::dvec3(1, 0, 0)));
    return mat3(vec3(right), vec3(glm::cross(back, right)), vec3(back));
}

void set_perspective(const tinygltf::PerspectiveCamera& source, Camera& camera) {
    if (source.yfov > 0) camera.yfov = float(std::clamp(source.yfov, 1e-3, 3.1));
    if (source.aspectRatio > 0) camera.aspect = float(std::clamp(source.aspectRatio, 1e-3, 1e3));
    if (source.znear > 0) camera.near = float(std::clamp(source.znear, 1e-15, 10.0));
}

/// Sets a perspective whose picture spans, at the distance of the scene's middle, the height that the orthographic
/// camera shows.
void set_orthographic(const tinygltf::OrthographicCamera& source, const Scene& scene, Camera& camera) {
    const double height = std::abs(source.ymag), width = std::abs(source.xmag);
    const vec3 middle = (scene.bounds[0] + scene.bounds[1]) * 0.5f;
    const double distance = std::max(double(dot(camera.position - middle, camera.rotation[2])), height);
    if (height > 0) camera.yfov = float(std::clamp(2 * std::atan(height / distance), 0.01, 2.6));
    if (height > 0 && width > 0) camera.aspect = float(std::clamp(width / height, 1e-3, 1e3));
}

/// Points the camera at a flat scene, such as a single floor or wall. `size` is that of the bounds, m; `flat` the axis
/// along which the scene is thin.
void face_flat_scene(vec3 size, int flat, Camera& camera) {
    vec3 back(0);
    back[flat] = 1;
    if (flat == 1) back = normalize(vec3(0, 1, 1));
    const vec3 right = normalize(cross(vec3(0, 1, 0), back));
    camera.position = back * (1.2f * std::max({size.x, size.y, size.z}));  // positions are relative to the middle
    camera.rotation = mat3(right, cross(back, right), back);
}

/// The camera for a file without one: in the middle of one end of the scene, at eye height (half way up in a low
/// scene), looking along its length.
Camera default_camera(const Scene& scene) {
    const vec3 low = scene.bounds[0], size = scene.bounds[1] - scene.bounds[0];
    Camera camera;
    camera.name = "default";
    camera.position = low + size * 0.5f;
    camera.position.y = low.y + (size.y > eye_height * 1.2f ? eye_height : size.y * 0.5f);
    const bool along_x = size.x > size.z;
    const vec3 back = along_x ? vec3(1, 0, 0) : vec3(0, 0, 1);
    camera.position += back * ((along_x ? size.x : size.z) * 0.45f);
    camera.rotation = mat3(cross(vec3(0, 1, 0), back), vec3(0, 1, 0), back);
    camera.yfov = 1.1f;
    const float longest = std::max({size.x, size.y, size.z});
    camera.near = std::clamp(longest * 1e-3f, 1e-15f, 0.05f);
    for (int side : {1, 2, 0})
        if (size[side] < 1e-3f * longest) {
            face_flat_scene(size, side, camera);
            break;
        }
    return camera;
}

std::string name_of_camera(const GltfFile& file, size_t node, const std::vector<std::string>& used_names) {
    const std::string& own = file.model.cameras[size_t(file.model.nodes[node].camera)].name;
    if (!own.empty() && std::count(used_names.begin(), used_names.end(), own) == 1) return own;
    const std::string& name = file.model.nodes[node].name;
    return !name.empty() ? name : !own.empty() ? own : "camera_" + std::to_string(node);
}

}  // namespace

void load_cameras(GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene) {
    std::vector<PlacedNode> places;
    std::vector<std::string> used_names;
    for (const PlacedNode& at : nodes) {
        const int index = file.model.nodes[at.node].camera;
        if (index < 0) continue;
        if (size_t(index) >= file.model.cameras.size())
            file.fail(label("node", at.node, file.model.nodes[at.node].name) + ": there is no camera " +
                      std::to_string(index));
        places.push_back(at);
        used_names.push_back(file.model.cameras[size_t(index)].name);
    }
    std::vector<std::string> names;
    for (const PlacedNode& at : places) {
        const tinygltf::Camera& source = file.model.cameras[size_t(file.model.nodes[at.node].camera)];
        Camera camera;
        camera.position = vec3(glm::dvec3(at.world[3]) - scene.origin);
        if (!(length(camera.position) < 2 * float(max_metres)))
            file.fail(label("node", at.node, file.model.nodes[at.node].name) + ": the camera is too far away");
        camera.rotation = rotation_of(at.world);
        if (source.type == "orthographic")
            set_orthographic(source.orthographic, scene, camera);
        else
            set_perspective(source.perspective, camera);
        names.push_back(name_of_camera(file, at.node, used_names));
        if (source.type == "orthographic")
            file.warn("the orthographic camera \"" + names.back() + "\" is shown in perspective");
        scene.cameras.push_back(camera);
    }
    make_unique(names);
    for (size_t i = 0; i < names.size(); ++i) scene.cameras[i].name = names[i];
    if (scene.cameras.empty()) scene.cameras.push_back(default_camera(scene));
}

}  // namespace lw
