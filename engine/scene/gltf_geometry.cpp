#include "scene/gltf_geometry.h"

#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>

#include "scene/gltf_skins.h"

namespace lw {
namespace {

using LocalMesh = std::vector<LocalPrimitive>;

/// One instance of a mesh.
struct PlacedMesh {
    size_t node;
    const LocalMesh* mesh;
    glm::dmat4 world;
};

/// Throws Error when the scene would not fit into memory. A short file can name one long accessor many times, so this
/// is checked before anything is decoded.
void check_counts(const GltfFile& file, uint64_t vertices, uint64_t triangles) {
    constexpr uint64_t bytes_per_vertex = 72,
                       bytes_per_triangle = 16;  // size in a Scene when all optional arrays are present
    check_memory(file, "its " + std::to_string(triangles) + " triangles",
                 vertices * bytes_per_vertex + triangles * bytes_per_triangle);
}

/// The meshes of a file, each decoded once for each pose that a node shows it in.
class MeshStore {
  public:
    MeshStore(GltfFile& file, const Scene& scene) : file_(file), scene_(scene) {}

    /// The mesh of a node, and where it stands.
    std::vector<PlacedMesh> place(const PlacedNode& at) {
        const tinygltf::Node& node = file_.model.nodes[at.node];
        std::vector<PlacedMesh> placed;
        if (node.mesh < 0) return placed;
        if (size_t(node.mesh) >= file_.model.meshes.size())
            file_.fail(label("node", at.node, node.name) + ": there is no mesh " + std::to_string(node.mesh));
        const LocalMesh& mesh = decoded(node);
        if (node.skin >= 0) return {pose(at.node, node.skin, mesh)};
        for (const glm::dmat4& world : instances_of(file_, at)) placed.push_back({at.node, &mesh, world});
        return placed;
    }

  private:
    const LocalMesh& decoded(const tinygltf::Node& node) {
        const tinygltf::Mesh& source = file_.model.meshes[size_t(node.mesh)];
        const MeshPose pose{node.weights.empty() ? source.weights : node.weights, node.skin >= 0};
        const auto [it, is_new] = meshes_.try_emplace({node.mesh, pose});
        for (size_t i = 0; is_new && i < source.primitives.size(); ++i)
            add(it->second, decode_primitive(file_, size_t(node.mesh), i, pose, scene_));
        return it->second;
    }

    PlacedMesh pose(size_t node, int skin, const LocalMesh& mesh) {
        if (worlds_.empty()) worlds_ = world_matrices(file_);
        const std::vector<glm::dmat4> joints = joint_matrices(file_, skin, worlds_);
        if (joints.empty()) file_.fail("skin " + std::to_string(skin) + " has no joints");
        const glm::dvec3 anchor(worlds_[size_t(file_.model.skins[size_t(skin)].joints[0])][3]);
        LocalMesh& result = posed_.emplace_back();
        for (const LocalPrimitive& primitive : mesh) add(result, posed(file_, primitive, joints, anchor));
        glm::dmat4 world(1);
        world[3] = glm::dvec4(anchor, 1);
        return {node, &result, world};
    }

    void add(LocalMesh& mesh, LocalPrimitive primitive) {
        vertices_ += primitive.positions.size();
        triangles_ += primitive.triangles.size();
        check_counts(file_, vertices_, triangles_);
        mesh.push_back(std::move(primitive));
    }

    GltfFile& file_;
    const Scene& scene_;
    std::map<std::pair<int, MeshPose>, LocalMesh> meshes_;
    std::deque<LocalMesh> posed_;  // of skinned nodes, which never share one
    std::vector<glm::dmat4> worlds_;
    uint64_t vertices_ = 0, triangles_ = 0;
};

glm::dvec3 transform_point(const glm::dmat4& m, vec3 p) { return glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1)); }

void find_origin(const GltfFile& file, const std::vector<PlacedMesh>& placed, Scene& scene) {
    uint64_t vertices = 0, triangles = 0;  // counted before anything is done with them
    for (const PlacedMesh& mesh : placed)
        for (const LocalPrimitive& p : *mesh.mesh) vertices += p.positions.size(), triangles += p.triangles.size();
    if (triangles == 0) file.fail("the scene has no triangles");
    if (std::max(vertices, triangles) >= std::numeric_limits<uint>::max())
        file.fail("the scene has more than 2^32 vertices or triangles");
    check_counts(file, vertices, triangles);
    glm::dvec3 low(std::numeric_limits<double>::max()), high = -low;
    for (const PlacedMesh& mesh : placed)
        for (const LocalPrimitive& p : *mesh.mesh)
            for (vec3 position : p.positions) {
                const glm::dvec3 world = transform_point(mesh.world, position);
                low = glm::min(low, world);
                high = glm::max(high, world);
            }
    const glm::dvec3 size = high - low;
    if (!(size.x < max_metres && size.y < max_metres && size.z < max_metres))
        file.fail("the scene is larger than 1e9 m");
    scene.origin = low + size * 0.5;
    scene.bounds = {vec3(low - scene.origin), vec3(high - scene.origin)};
    scene.positions.reserve(vertices);
    scene.normals.reserve(vertices);
    scene.triangles.reserve(triangles);
    scene.triangle_objects.reserve(triangles);
}

/// Appends an optional attribute of one primitive. The scene's array stays empty until the first primitive that has the
/// attribute; vertices without it hold `otherwise`.
template <class T>
void append_optional(std::vector<T>& all, const std::vector<T>& own, size_t first, size_t count, T otherwise) {
    if (all.empty() && own.empty()) return;
    all.resize(first, otherwise);
    if (own.empty())
        all.resize(first + count, otherwise);
    else
        all.insert(all.end(), own.begin(), own.end());
}

void append_tangents(Scene& scene, const LocalPrimitive& p, const glm::dmat3& m, size_t first) {
    std::vector<vec4> world;
    const float mirror = glm::determinant(m) < 0 ? -1.0f : 1.0f;
    for (vec4 t : p.tangents) world.emplace_back(unit_or(m * glm::dvec3(t), vec3(0)), t.w * mirror);
    append_optional(scene.tangents, world, first, p.positions.size(), vec4(0, 0, 0, 1));
}

void append_vertices(const PlacedMesh& mesh, const LocalPrimitive& p, Scene& scene) {
    const size_t first = scene.positions.size(), count = p.positions.size();
    const glm::dmat3 for_normals = normal_matrix(mesh.world);
    for (vec3 position : p.positions)
        scene.positions.emplace_back(transform_point(mesh.world, position) - scene.origin);
    for (vec3 normal : p.normals) scene.normals.push_back(unit_or(for_normals * glm::dvec3(normal), vec3(0, 1, 0)));
    append_optional(scene.uv0, p.uv0, first, count, vec2(0));
    append_optional(scene.uv1, p.uv1, first, count, vec2(0));
    append_optional(scene.colors, p.colors, first, count, vec4(1));
    append_tangents(scene, p, glm::dmat3(mesh.world), first);
}

void append_triangles(const PlacedMesh& mesh, const LocalPrimitive& p, size_t first_vertex, Scene& scene) {
    const bool mirrored = glm::determinant(glm::dmat3(mesh.world)) < 0;
    for (uvec3 t : p.triangles) {
        if (mirrored) std::swap(t.y, t.z);
        scene.triangles.push_back(t + uint(first_vertex));
        scene.triangle_objects.push_back(uint(scene.objects.size()));
    }
}

/// The material record of a primitive; those that name none share one default.
uint material_of(const LocalPrimitive& p, Scene& scene, std::optional<uint>& default_index) {
    if (p.material >= 0) return uint(p.material);
    if (!default_index) {
        default_index = uint(scene.materials.size());
        scene.materials.push_back(default_material());
        scene.material_names.push_back("default");
    }
    return *default_index;
}

}  // namespace

std::vector<size_t> load_geometry(GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene) {
    MeshStore meshes(file, scene);
    std::vector<PlacedMesh> placed;
    for (const PlacedNode& at : nodes)
        for (const PlacedMesh& mesh : meshes.place(at)) placed.push_back(mesh);
    find_origin(file, placed, scene);
    std::optional<uint> default_index;
    std::vector<size_t> object_nodes;
    for (const PlacedMesh& mesh : placed) {
        const std::string name = name_of(file, mesh.node, "node");
        for (const LocalPrimitive& p : *mesh.mesh) {
            if (p.triangles.empty()) continue;
            const size_t first_vertex = scene.positions.size();
            append_vertices(mesh, p, scene);
            append_triangles(mesh, p, first_vertex, scene);
            scene.objects.push_back({material_of(p, scene, default_index), -1});
            scene.object_names.push_back(name);
            object_nodes.push_back(mesh.node);
        }
    }
    return object_nodes;
}

}  // namespace lw
