#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/gltf_accessor.h"

namespace lw {
namespace {

glm::dmat4 compose(glm::dvec3 translation, glm::dquat rotation, glm::dvec3 scale) {
    const double norm = glm::length(rotation);
    glm::dmat4 matrix = glm::mat4_cast(norm > 0 ? rotation / norm : glm::dquat(1, 0, 0, 0));
    for (int i = 0; i < 3; ++i) matrix[i] *= scale[i];
    matrix[3] = glm::dvec4(translation, 1);
    return matrix;
}

/// KHR_node_visibility: a node that is not visible hides all below it.
bool is_hidden(const tinygltf::Node& node) {
    const tinygltf::Value* extension = extension_of(node.extensions, "KHR_node_visibility");
    return extension && extension->Has("visible") && extension->Get("visible").IsBool() &&
           !extension->Get("visible").Get<bool>();
}

bool is_finite(const glm::dmat4& matrix) {
    const double* values = glm::value_ptr(matrix);
    return std::all_of(values, values + 16, [](double v) { return std::isfinite(v); });
}

std::vector<int> roots(const GltfFile& file) {
    const tinygltf::Model& model = file.model;
    if (!model.scenes.empty()) {
        const int scene = std::max(model.defaultScene, 0);
        if (size_t(scene) >= model.scenes.size()) file.fail("there is no scene " + std::to_string(scene));
        return model.scenes[size_t(scene)].nodes;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (int child : node.children)
            if (child >= 0 && size_t(child) < is_child.size()) is_child[size_t(child)] = true;
    std::vector<int> nodes;
    for (size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) nodes.push_back(int(i));
    return nodes;
}

}  // namespace

glm::dmat4 local_matrix(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    const auto vector3 = [](const std::vector<double>& v, double otherwise) {
        return v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(otherwise);
    };
    const std::vector<double>& r = node.rotation;
    return compose(vector3(node.translation, 0),
                   r.size() == 4 ? glm::dquat(r[3], r[0], r[1], r[2]) : glm::dquat(1, 0, 0, 0), vector3(node.scale, 1));
}

glm::dmat3 normal_matrix(const glm::dmat4& world) {
    const glm::dmat3 m(world);
    const double sign = glm::determinant(m) < 0 ? -1 : 1;
    return sign * glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

vec3 unit_or(glm::dvec3 v, vec3 otherwise) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? vec3(v / length) : otherwise;
}

std::vector<PlacedNode> place_nodes(const GltfFile& file) {
    struct Visit {
        int node;
        glm::dmat4 world;
        int parent;
    };
    const tinygltf::Model& model = file.model;
    std::vector<Visit> stack;
    const std::vector<int> first = roots(file);
    for (auto it = first.rbegin(); it != first.rend(); ++it) stack.push_back({*it, glm::dmat4(1), -1});

    std::vector<bool> visited(model.nodes.size(), false);
    std::vector<PlacedNode> placed;
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        if (visit.node < 0 || size_t(visit.node) >= model.nodes.size())
            file.fail("there is no node " + std::to_string(visit.node));
        const size_t index = size_t(visit.node);
        const tinygltf::Node& node = model.nodes[index];
        if (visited[index]) file.fail(label("node", index, node.name) + ": is its own ancestor or has two parents");
        visited[index] = true;
        if (is_hidden(node)) continue;
        const glm::dmat4 world = visit.world * local_matrix(node);
        if (!is_finite(world)) file.fail(label("node", index, node.name) + ": the transformation is not finite");
        placed.push_back({index, world, visit.parent});
        for (auto it = node.children.rbegin(); it != node.children.rend(); ++it)
            stack.push_back({*it, world, visit.node});
    }
    return placed;
}

std::vector<glm::dmat4> instances_of(const GltfFile& file, const PlacedNode& placed) {
    const tinygltf::Node& node = file.model.nodes[placed.node];
    const tinygltf::Value* extension = extension_of(node.extensions, "EXT_mesh_gpu_instancing");
    if (!extension || !extension->Has("attributes")) return {placed.world};
    const std::string where = label("node", placed.node, node.name) + ": EXT_mesh_gpu_instancing";
    const tinygltf::Value& attributes = extension->Get("attributes");

    size_t count = 0;
    const auto read = [&](const char* key, size_t components) {
        const int accessor = index_of(attributes, key, -1);
        FloatRows rows;
        if (accessor < 0) return rows;
        rows = read_floats(file, accessor, where);
        if (rows.components != components || (count && rows.count != count))
            file.fail(where + ": " + key + " has the wrong size");
        count = rows.count;
        return rows;
    };
    const FloatRows translation = read("TRANSLATION", 3), rotation = read("ROTATION", 4), scale = read("SCALE", 3);
    const auto vector3 = [](const FloatRows& rows, size_t i, double otherwise) {
        return rows.count ? glm::dvec3(rows.row(i)[0], rows.row(i)[1], rows.row(i)[2]) : glm::dvec3(otherwise);
    };
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < count; ++i) {
        const float* r = rotation.count ? rotation.row(i) : nullptr;
        const glm::dquat q = r ? glm::dquat(r[3], r[0], r[1], r[2]) : glm::dquat(1, 0, 0, 0);
        matrices.push_back(placed.world * compose(vector3(translation, i, 0), q, vector3(scale, i, 1)));
        if (!is_finite(matrices.back())) file.fail(where + ": instance " + std::to_string(i) + " is not finite");
    }
    return matrices;
}

std::string name_of(const GltfFile& file, size_t node, const std::string& otherwise) {
    const std::string& name = file.model.nodes[node].name;
    return name.empty() ? otherwise + "_" + std::to_string(node) : name;
}

}  // namespace lw
