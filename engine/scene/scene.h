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

/// A scene as load_scene() returns it. Arrays that are said to be per something have one entry for each of it, in the
/// same order.
struct Scene {
    std::filesystem::path path;  // the glTF file
    glm::dvec3 origin{0};        // world position = origin + stored position

    // Vertices of all instances in world space, one entry a vertex. uv0 to tangents are empty when no material needs
    // them.
    std::vector<vec3> positions;  // m
    std::vector<vec3> normals;    // unit shading normals; at a sharp edge a vertex stands once for each
    std::vector<vec2> uv0, uv1;   // texture coordinates, 0 to 1 across the image
    std::vector<vec4> colors;     // linear RGBA multipliers
    std::vector<vec4> tangents;   // unit, and in w the handedness, 1 or -1; only when a normal map exists

    std::vector<uvec3> triangles;           // indices of vertices, counter-clockwise seen from the front
    std::vector<uint> triangle_objects;     // index of its object, per triangle
    std::vector<Object> objects;            // each has its triangles one after the other
    std::vector<std::string> object_names;  // name of the glTF node, per object
    std::vector<Material> materials;
    std::vector<std::string> material_names;  // per material
    std::vector<Texture> textures;
    std::vector<uint>
        texels;  // RGBA8 of all textures, R in the low byte; behind them the tables of shaders/profile.glsl

    std::vector<Light> lights;
    std::vector<std::string> light_names;   // per light, no two alike
    std::vector<std::string> light_groups;  // per light: name of the node above it, "" at the root
    std::set<size_t> mirrored_lights;  // indices of lights whose nodes mirror: their angle C grows the other way around
    std::vector<Emitter> emitters;     // triangles of mesh lights, those of a light one after the other
    std::vector<Camera> cameras;       // at least one

    std::array<vec3, 2> bounds{vec3(0), vec3(0)};  // smallest and largest coordinates of positions, m
    uint64_t content_hash = 0;          // of geometry, materials, places and shapes of lamps; not of powers or cameras
    std::vector<std::string> warnings;  // what the loader ignored or replaced, each message once
    std::vector<std::filesystem::path> files;  // all it was read from; no output may overwrite one

    /// Length of the diagonal of the bounds, m.
    float size() const { return length(bounds[1] - bounds[0]); }
    /// How far above their surface rays start, m: a few units of float precision at the largest coordinate.
    float ray_epsilon() const {
        const vec3 reach = max(abs(bounds[0]), abs(bounds[1]));
        return 4e-6f * max(max(reach.x, reach.y), max(reach.z, 1e-30f));
    }
    /// The material of a triangle, by the triangle's index.
    const Material& material_of(uint triangle) const { return materials[objects[triangle_objects[triangle]].material]; }
};

}  // namespace lw
