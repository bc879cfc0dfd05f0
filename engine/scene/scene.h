// A building as plain arrays: world-space triangles, materials, lamps and cameras. Metres, right-handed, Y up.
// All positions are relative to `origin` (double), so that a scene far from zero keeps its precision.
// The arrays are the GPU's arrays: records come from shaders/scene.h, scalar layout.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "shaders/scene.h"

namespace lw {

/// A pinhole camera; the view looks along -Z of `rotation`, Y up (glTF).
struct Camera {
    std::string name;
    vec3 position{0};
    mat3 rotation{1};    // columns: right, up, back
    float yfov = 0.9f;   // radians; of an orthographic camera an equivalent perspective is used
    float aspect = 0;    // width / height, 0 when the file leaves it to the window
    float near = 0.05f;  // m
};

struct Scene {
    std::filesystem::path path;
    glm::dvec3 origin{0};  // world position = origin + stored position

    // Vertices of all instances in world space. Optional arrays are empty when no material needs them.
    std::vector<vec3> positions;
    std::vector<vec3> normals;   // unit shading normals, per vertex (flat ones are duplicated vertices)
    std::vector<vec2> uv0, uv1;  // texture coordinates
    std::vector<vec4> colors;    // linear RGBA multipliers
    std::vector<vec4> tangents;  // xyz + handedness; only when a normal map exists

    std::vector<uvec3> triangles;        // vertex indices; front face counter-clockwise (mirroring corrected)
    std::vector<uint> triangle_objects;  // object of each triangle
    std::vector<Object> objects;
    std::vector<std::string> object_names;  // node name, per object
    std::vector<Material> materials;
    std::vector<std::string> material_names;
    std::vector<Texture> textures;
    std::vector<uint> texels;  // RGBA8 of all textures

    std::vector<Light> lights;
    std::vector<std::string> light_names;   // unique; per light
    std::vector<std::string> light_groups;  // name of the node above each light, "" at the root
    std::set<size_t> mirrored_lights;       // lamps whose nodes mirror: C grows the other way around
    std::vector<Emitter> emitters;          // triangles of mesh lights, grouped per light
    std::vector<Camera> cameras;            // at least one

    std::array<vec3, 2> bounds{vec3(0), vec3(0)};  // min, max of positions
    uint64_t content_hash = 0;          // geometry, materials, lamps' places and shapes; not their powers or cameras
    std::vector<std::string> warnings;  // what the loader ignored or replaced, each message once
    std::vector<std::filesystem::path> files;  // all files it was read from: outputs must not overwrite them

    /// Length of the diagonal of the bounds, m.
    float size() const { return length(bounds[1] - bounds[0]); }
    /// How far above their surface rays start, m: a few units of float precision at the largest coordinate.
    float ray_epsilon() const {
        const vec3 reach = max(abs(bounds[0]), abs(bounds[1]));
        return 4e-6f * max(max(reach.x, reach.y), max(reach.z, 1e-30f));
    }
    const Material& material_of(uint triangle) const { return materials[objects[triangle_objects[triangle]].material]; }
};

}  // namespace lw
