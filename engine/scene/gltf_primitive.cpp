#include "scene/gltf_primitive.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scene/gltf_accessor.h"
#include "scene/tangents.h"
#include "scene/triangle.h"

namespace lw {
namespace {

bool is_finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Corner triples from a list, strip or fan; the corners of a strip keep the front face of its first triangle.
std::vector<uvec3> triangles_of(const std::vector<uint32_t>& corners, int mode) {
    std::vector<uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(corners.size() / 3);
        for (size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        return triangles;
    }
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        uvec3 t(corners[i], corners[i + 1], corners[i + 2]);
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            t.x = corners[0];
        else if (i % 2)
            std::swap(t.x, t.y);
        if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);  // repeated corners only stitch strips
    }
    return triangles;
}

std::vector<uvec3> read_triangles(GltfFile& file, const tinygltf::Primitive& primitive, size_t vertex_count,
                                  const std::string& where) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        file.warn(where + ": points and lines are skipped");
        return {};
    }
    std::vector<uint32_t> corners;
    if (primitive.indices >= 0) {
        corners = read_indices(file, primitive.indices, where + ": indices");
    } else {
        corners.resize(vertex_count);
        std::iota(corners.begin(), corners.end(), 0u);
    }
    for (uint32_t corner : corners)
        if (corner >= vertex_count)
            file.fail(where + ": index " + std::to_string(corner) + " is out of range, there are " +
                      std::to_string(vertex_count) + " vertices");
    if (mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3)
        file.warn(where + ": the last triangle is incomplete and skipped");
    return triangles_of(corners, mode);
}

/// Chooses the vertices to keep and renumbers the triangles to match. Returns the index in the file of each kept
/// vertex. With `flat` every corner of a triangle becomes a vertex of its own.
std::vector<uint32_t> keep_vertices(std::vector<uvec3>& triangles, size_t vertex_count, bool flat) {
    constexpr uint32_t unseen = ~0u;
    std::vector<uint32_t> kept, place(flat ? 0 : vertex_count, unseen);
    for (uvec3& t : triangles) {
        for (int c = 0; c < 3; ++c) {
            const uint32_t source = t[c];
            if (flat || place[source] == unseen) {
                if (!flat) place[source] = uint32_t(kept.size());
                t[c] = uint32_t(kept.size());
                kept.push_back(source);
            } else {
                t[c] = place[source];
            }
        }
    }
    return kept;
}

vec3 face_normal(const LocalPrimitive& p, uvec3 t) {
    const glm::dvec3 n =
        edge_product(glm::dvec3(p.positions[t.x]), glm::dvec3(p.positions[t.y]), glm::dvec3(p.positions[t.z]));
    const double length = glm::length(n);
    return length > 0 && std::isfinite(length) ? vec3(n / length) : vec3(0, 1, 0);
}

/// Makes all normals unit length. A vertex whose normal is zero or not finite gets the normal of a triangle at it.
void repair_normals(LocalPrimitive& p) {
    p.normals.resize(p.positions.size(), vec3(0));
    const auto usable = [](vec3 n) { return is_finite(n) && dot(n, n) > 1e-12f && dot(n, n) < 1e12f; };
    for (vec3& n : p.normals) n = usable(n) ? normalize(n) : vec3(0);
    for (uvec3 t : p.triangles)
        for (int c = 0; c < 3; ++c)
            if (p.normals[t[c]] == vec3(0)) p.normals[t[c]] = face_normal(p, t);
}

using Attributes = std::map<std::string, int>;  // name to accessor

/// Reader of the attributes of a primitive or of a morph target: rows for the kept vertices, or nothing when the
/// attribute is absent.
class AttributeReader {
  public:
    AttributeReader(const GltfFile& file, const Attributes& attributes, const std::string& where)
        : file_(file), attributes_(attributes), where_(where) {}

    std::optional<FloatRows> rows(const std::string& name, size_t least, size_t most) const {
        const auto it = attributes_.find(name);
        if (it == attributes_.end()) return {};
        FloatRows found = read_floats(file_, it->second, where_ + ": " + name);
        if (found.components < least || found.components > most)
            file_.fail(where_ + ": " + name + " has the wrong type");
        return found;
    }

    /// Vectors of N floats; a component the file lacks (alpha of a colour) is 1.
    template <int N>
    std::vector<glm::vec<N, float>> gather(const std::string& name, size_t least, const std::vector<uint32_t>& kept,
                                           size_t vertex_count) const {
        std::vector<glm::vec<N, float>> vectors;
        const std::optional<FloatRows> found = rows(name, least, N);
        if (!found) return vectors;
        if (found->count != vertex_count) file_.fail(where_ + ": " + name + " and POSITION differ in length");
        vectors.assign(kept.size(), glm::vec<N, float>(1));
        for (size_t i = 0; i < kept.size(); ++i)
            for (size_t c = 0; c < found->components; ++c) {
                const float value = found->row(kept[i])[c];
                if (!std::isfinite(value) && name == "COLOR_0")
                    file_.fail(where_ + ": " + name + " of vertex " + std::to_string(kept[i]) + " is not finite");
                vectors[i][glm::length_t(c)] = std::isfinite(value) ? value : 0.0f;
            }
        return vectors;
    }

  private:
    const GltfFile& file_;
    const Attributes& attributes_;
    const std::string& where_;
};

void read_optional(const AttributeReader& reader, const std::vector<uint32_t>& kept, size_t vertex_count,
                   const Scene& scene, LocalPrimitive& p) {
    const VertexNeeds needs = vertex_needs(scene);
    if (needs.uv0) p.uv0 = reader.gather<2>("TEXCOORD_0", 2, kept, vertex_count);
    if (needs.uv1) p.uv1 = reader.gather<2>("TEXCOORD_1", 2, kept, vertex_count);
    p.colors = reader.gather<4>("COLOR_0", 3, kept, vertex_count);
    for (vec4& c : p.colors)
        c = clamp(c, vec4(0), vec4(1));  // they multiply reflectances: above 1 they would create light
    const Material m = p.material < 0 ? default_material() : scene.materials[size_t(p.material)];
    if (m.normal_texture.texture < 0) return;
    p.tangents = reader.gather<4>("TANGENT", 4, kept, vertex_count);
    const std::vector<vec2>& uv = m.normal_texture.texcoord == 0 ? p.uv0 : p.uv1;
    if (p.tangents.empty() && !uv.empty()) p.tangents = make_tangents(p.positions, p.normals, uv, p.triangles);
}

/// The morph targets of a primitive, and how much of each is added.
struct MorphTargets {
    const GltfFile& file;
    const tinygltf::Primitive& primitive;
    const std::string& where;            // the primitive, for messages
    const std::vector<double>& weights;  // per target
    const std::vector<uint32_t>& kept;   // vertices of the file that are used
    size_t vertex_count;                 // of the file

    /// Adds the weighted displacements of one attribute of all targets; `values`: one per kept vertex, or none.
    template <class V>
    void displace(const std::string& name, std::vector<V>& values) const {
        if (values.empty()) return;
        for (size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
            if (weights[t] == 0) continue;
            const std::string target = where + ": morph target " + std::to_string(t);
            const std::vector<vec3> moves =
                AttributeReader(file, primitive.targets[t], target).gather<3>(name, 3, kept, vertex_count);
            for (size_t i = 0; i < moves.size(); ++i) {
                values[i].x += float(weights[t]) * moves[i].x;
                values[i].y += float(weights[t]) * moves[i].y;
                values[i].z += float(weights[t]) * moves[i].z;
            }
        }
    }
};

/// The joints and weights of the kept vertices; a vertex without weight follows its first joint.
std::vector<JointWeights> read_joints(const GltfFile& file, const AttributeReader& reader,
                                      const std::vector<uint32_t>& kept, size_t vertex_count,
                                      const std::string& where) {
    std::vector<JointWeights> all(kept.size());
    for (size_t set = 0; set < 2; ++set) {
        const std::string number = std::to_string(set);
        const std::optional<FloatRows> joints = reader.rows("JOINTS_" + number, 4, 4);
        const std::optional<FloatRows> weights = reader.rows("WEIGHTS_" + number, 4, 4);
        if (!joints || !weights) break;
        if (joints->count != vertex_count || weights->count != vertex_count)
            file.fail(where + ": JOINTS_" + number + " or WEIGHTS_" + number + " and POSITION differ in length");
        for (size_t i = 0; i < kept.size(); ++i)
            for (size_t c = 0; c < 4; ++c) {
                const float weight = weights->row(kept[i])[c];
                all[i].joints[4 * set + c] = uint(joints->row(kept[i])[c]);
                all[i].weights[4 * set + c] = std::isfinite(weight) ? std::max(weight, 0.0f) : 0.0f;
            }
    }
    for (JointWeights& vertex : all) {
        const float sum = std::accumulate(vertex.weights.begin(), vertex.weights.end(), 0.0f);
        if (!(sum > 0)) vertex.weights[0] = 1;
        for (float& weight : vertex.weights) weight /= sum > 0 ? sum : 1.0f;
    }
    return all;
}

}  // namespace

LocalPrimitive decode_primitive(GltfFile& file, size_t mesh, size_t index, const MeshPose& pose, const Scene& scene) {
    const tinygltf::Mesh& owner = file.model.meshes[mesh];
    const tinygltf::Primitive& source = owner.primitives[index];
    const std::string where = label("mesh", mesh, owner.name) + ": primitive " + std::to_string(index);
    if (!source.attributes.contains("POSITION")) file.fail(where + " has no POSITION");
    if (source.material >= int(file.model.materials.size()))
        file.fail(where + ": there is no material " + std::to_string(source.material));

    LocalPrimitive p;
    p.material = source.material;
    const AttributeReader reader(file, source.attributes, where);
    const FloatRows positions = *reader.rows("POSITION", 3, 3);
    p.triangles = read_triangles(file, source, positions.count, where);
    const bool flat = !source.attributes.contains("NORMAL");
    const std::vector<uint32_t> kept = keep_vertices(p.triangles, positions.count, flat);
    p.positions.reserve(kept.size());
    for (uint32_t vertex : kept) {
        const float* v = positions.row(vertex);
        p.positions.emplace_back(v[0], v[1], v[2]);
    }
    const MorphTargets morph{file, source, where, pose.morph_weights, kept, positions.count};
    morph.displace("POSITION", p.positions);
    for (size_t i = 0; i < kept.size(); ++i)
        if (!is_finite(p.positions[i]))
            file.fail(where + ": the position of vertex " + std::to_string(kept[i]) + " is not finite");
    p.normals = reader.gather<3>("NORMAL", 3, kept, positions.count);
    morph.displace("NORMAL", p.normals);
    repair_normals(p);
    read_optional(reader, kept, positions.count, scene, p);
    morph.displace("TANGENT", p.tangents);
    if (pose.is_skinned) p.joints = read_joints(file, reader, kept, positions.count, where);
    return p;
}

}  // namespace lw
