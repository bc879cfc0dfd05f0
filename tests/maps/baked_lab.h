// Baked scenes of rectangles, and what brute force says about places in them.
#pragma once
#include <array>
#include <cmath>

#include "benchmark/lab_scene.h"
#include "maps/bake.h"
#include "maps/plane_grids.h"
#include "trace/ray_caster.h"

namespace lw::test {

struct BakedLab {
    BakedLab(Scene made, const BakeSettings& settings)
        : scene(std::move(made)), caster(scene), map(bake(scene, caster, settings)) {}

    std::array<vec3, 3> corners(size_t triangle) const {
        const uvec3 c = scene.triangles[triangle];
        return {scene.positions[c.x], scene.positions[c.y], scene.positions[c.z]};
    }

    Scene scene;
    RayCaster caster;
    PhotonMap map;
};

/// A node of the lattice of a map that is one triangle, in the plane of it.
struct Node {
    uint map, index;  // index among the nodes of all maps
    vec2 cells;       // steps from the first node of its lattice
    vec3 position;
    vec3 on_triangle;  // the point nearest to it
};

/// Calls visit(node) for all nodes of maps of one triangle that is not cut, but those farther from it than a cell.
template <class Visit>
void for_each_node(const BakedLab& lab, const Visit& visit) {
    std::vector<uint> sides(lab.map.grids.size(), 0);
    for (uint m : lab.map.grid_of_side)
        if (m != no_grid && !is_cut(m)) ++sides[m];
    for (size_t side = 0; side < lab.map.grid_of_side.size(); ++side) {
        const uint m = lab.map.grid_of_side[side];
        if (m == no_grid || is_cut(m) || sides[m] > 1) continue;
        const SurfaceGrid& grid = lab.map.grids[m];
        const auto [a, b, c] = lab.corners(side / 2);
        for (uint y = 0; y < grid.lattice.rows; ++y)
            for (uint x = 0; x < grid.lattice.columns; ++x) {
                const vec2 cells{float(x), float(y)};
                const vec3 position = point_on_lattice(grid, cells, dot(a - grid.origin, grid.normal));
                const vec3 nearest = closest_point_on_triangle(position, a, b, c);
                if (length(nearest - position) < 0.99f * length(grid.lattice.step))
                    visit(Node{m, grid.lattice.first_node + y * grid.lattice.columns + x, cells, position, nearest});
            }
    }
}

/// Whether a straight line between two points meets a triangle between its ends (Moeller & Trumbore 1997).
inline bool is_blocked(const BakedLab& lab, glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 way = to - from;
    for (size_t t = 0; t < lab.scene.triangles.size(); ++t) {
        const auto [a, b, c] = lab.corners(t);
        const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), ac = glm::dvec3(c) - glm::dvec3(a);
        const glm::dvec3 p = glm::cross(way, ac), offset = from - glm::dvec3(a), q = glm::cross(offset, ab);
        const double determinant = glm::dot(ab, p);
        if (std::abs(determinant) < 1e-12) continue;
        const double u = glm::dot(offset, p) / determinant, v = glm::dot(way, q) / determinant,
                     at = glm::dot(ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && at > 1e-4 && at < 1 - 1e-4) return true;
    }
    return false;
}

}  // namespace lw::test
