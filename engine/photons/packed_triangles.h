// All that a photon needs to know of a matte triangle, in one cache line of 64 bytes. Photons meet triangles in random
// order, so reading the separate arrays of a Scene would cost eight cache misses each time.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"

namespace lw {

struct alignas(64) PackedTriangle {
    std::array<vec3, 3> corners;  // m
    vec3 normal;                  // unit, of the front face
    vec3 base_color;
    uint is_matte : 1;  // a Lambert reflector of one colour, for which these members are enough
    uint is_flat : 1;   // the shading normals equal the geometric normal
};
static_assert(sizeof(PackedTriangle) == 64);

/// The records of all triangles of a scene, in its order. Positions and normals are those that surface_at() gives.
std::vector<PackedTriangle> pack_triangles(const Scene& scene);

}  // namespace lw
