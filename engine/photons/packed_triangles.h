// What a photon reads of a matte triangle that it meets, in one line of cache: photons meet triangles in random order,
// and the arrays of a Scene would make them wait eight times.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"

namespace lw {

struct alignas(64) PackedTriangle {
    std::array<vec3, 3> corners;  // m
    vec3 normal;                  // unit, of the front face
    vec3 base_color;
    uint is_matte : 1;  // a Lambert reflector of one colour: the other members are all there is to know
    uint is_flat : 1;   // the shading normals are the geometric one
};
static_assert(sizeof(PackedTriangle) == 64);

/// The records of all triangles; positions and normals are those of surface_at().
std::vector<PackedTriangle> pack_triangles(const Scene& scene);

}  // namespace lw
