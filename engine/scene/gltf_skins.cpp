#include "scene/gltf_skins.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scene/gltf_accessor.h"
#include "scene/gltf_nodes.h"

namespace lw {
namespace {

glm::dmat4 inverse_bind(const FloatRows& rows, size_t joint) {
    glm::dmat4 matrix(1);
    for (size_t i = 0; i < 16 && rows.count > 0; ++i) glm::value_ptr(matrix)[i] = double(rows.row(joint)[i]);
    return matrix;
}

/// The mean of the matrices of a vertex's joints.
glm::dmat4 blended(const GltfFile& file, const JointWeights& vertex, const std::vector<glm::dmat4>& joints) {
    glm::dmat4 sum(0);
    for (size_t i = 0; i < vertex.weights.size(); ++i) {
        if (!(vertex.weights[i] > 0)) continue;
        if (vertex.joints[i] >= joints.size())
            file.fail("a vertex names joint " + std::to_string(vertex.joints[i]) + " of a skin that has " +
                      std::to_string(joints.size()));
        sum += joints[vertex.joints[i]] * double(vertex.weights[i]);
    }
    return sum;
}

}  // namespace

std::vector<glm::dmat4> world_matrices(const GltfFile& file) {
    const std::vector<tinygltf::Node>& nodes = file.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (size_t n = 0; n < nodes.size(); ++n)
        for (int child : nodes[n].children)
            if (child >= 0 && size_t(child) < nodes.size()) parents[size_t(child)] = int(n);
    std::vector<glm::dmat4> worlds(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) {
        worlds[n] = local_matrix(nodes[n]);
        size_t steps = 0;
        for (int up = parents[n]; up >= 0 && steps <= nodes.size(); up = parents[size_t(up)], ++steps)
            worlds[n] = local_matrix(nodes[size_t(up)]) * worlds[n];
        if (steps > nodes.size()) file.fail(label("node", n, nodes[n].name) + ": is its own ancestor");
    }
    return worlds;
}

std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int skin, const std::vector<glm::dmat4>& worlds) {
    if (size_t(skin) >= file.model.skins.size()) file.fail("there is no skin " + std::to_string(skin));
    const tinygltf::Skin& source = file.model.skins[size_t(skin)];
    const std::string where = label("skin", size_t(skin), source.name);
    FloatRows rows;
    if (source.inverseBindMatrices >= 0) {
        rows = read_floats(file, source.inverseBindMatrices, where + ": inverseBindMatrices");
        if (rows.components != 16 || rows.count < source.joints.size())
            file.fail(where + ": inverseBindMatrices are not a matrix for each joint");
    }
    std::vector<glm::dmat4> matrices;
    for (size_t j = 0; j < source.joints.size(); ++j) {
        const int node = source.joints[j];
        if (node < 0 || size_t(node) >= worlds.size()) file.fail(where + ": there is no node " + std::to_string(node));
        matrices.push_back(worlds[size_t(node)] * inverse_bind(rows, j));
        const double* values = glm::value_ptr(matrices.back());
        if (!std::all_of(values, values + 16, [](double v) { return std::isfinite(v); }))
            file.fail(where + ": the matrix of joint " + std::to_string(j) + " is not finite");
    }
    return matrices;
}

LocalPrimitive posed(const GltfFile& file, const LocalPrimitive& primitive, const std::vector<glm::dmat4>& joints,
                     glm::dvec3 anchor) {
    LocalPrimitive result = primitive;
    for (size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::dmat4 matrix = blended(file, primitive.joints[i], joints);
        result.positions[i] = vec3(glm::dvec3(matrix * glm::dvec4(glm::dvec3(primitive.positions[i]), 1)) - anchor);
        result.normals[i] = unit_or(normal_matrix(matrix) * glm::dvec3(primitive.normals[i]), vec3(0, 1, 0));
        if (primitive.tangents.empty()) continue;
        const vec3 along = unit_or(glm::dmat3(matrix) * glm::dvec3(primitive.tangents[i]), vec3(0));
        result.tangents[i] = vec4(along, primitive.tangents[i].w);
    }
    return result;
}

}  // namespace lw
