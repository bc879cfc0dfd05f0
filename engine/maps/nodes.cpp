#include "maps/nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "maps/outline.h"
#include "scene/triangle.h"
#include "trace/ray_caster.h"

namespace lw {
namespace {

constexpr float max_nodes_across = 16384;
constexpr float drawn_in = 0.02f;  // steps

/// The triangle sides of each grid: those of grid m are sides[starts[m]] .. sides[starts[m + 1] - 1].
struct SidesOfGrids {
    explicit SidesOfGrids(const SurfaceGrids& map) : starts(map.grids.size() + 1, 0) {
        for (uint index : map.grid_of_side) map.for_each_grid(index, [&](uint m) { ++starts[m + 1]; });
        for (size_t m = 1; m < starts.size(); ++m) starts[m] += starts[m - 1];
        sides.resize(starts.back());
        std::vector<uint> next(starts.begin(), starts.end() - 1);
        for (size_t side = 0; side < map.grid_of_side.size(); ++side)
            map.for_each_grid(map.grid_of_side[side], [&](uint m) { sides[next[m]++] = uint(side); });
    }
    std::vector<uint> starts, sides;
};

/// Nodes along an edge of `size` m.
uint nodes_along(float size, float spacing) {
    return uint(clamp(std::ceil(size / spacing), 1.0f, max_nodes_across)) + 1;
}

SurfaceLattice fit_lattice(const PatchShape& shape, const SurfaceGrid& grid, float spacing) {
    SurfaceLattice lattice{};
    const vec3 extent = shape.high - shape.low;
    lattice.low = vec2(position_in_grid(grid, shape.anchor)) + vec2(shape.low);
    lattice.columns = nodes_along(extent.x, spacing);
    lattice.rows = nodes_along(extent.y, spacing);
    lattice.step = max(vec2(extent.x, extent.y) / vec2(float(lattice.columns - 1), float(lattice.rows - 1)),
                       vec2(1e-4f * spacing));
    return lattice;
}

/// The outline of a piece in the frame of its lattice, drawn in by so little that points on it lie on its own side of
/// walls.
std::vector<vec2> outline_in(const PatchShape& shape, const SurfaceLattice& lattice) {
    std::vector<vec2> outline;
    vec2 middle(0);
    for (vec2 p : shape.outline) {
        outline.push_back(p - vec2(shape.low));
        middle += outline.back() / float(shape.outline.size());
    }
    for (vec2& p : outline) {
        const vec2 inwards = middle - p;
        p += inwards *
             std::min(0.5f, 2e-3f * std::max(lattice.step.x, lattice.step.y) / std::max(length(inwards), 1e-20f));
    }
    return outline;
}

/// Weights of the second and third corner of the point of triangle abc (in 2D) nearest to the origin.
vec2 nearest_barycentrics(vec2 a, vec2 b, vec2 c, vec2& nearest) {
    const vec3 p = closest_point_on_triangle(vec3(0), vec3(a, 0), vec3(b, 0), vec3(c, 0));
    nearest = vec2(p.x, p.y);
    const vec2 ab = b - a, ac = c - a, ap = nearest - a;
    const float doubled = ab.x * ac.y - ab.y * ac.x;
    if (std::abs(doubled) < 1e-20f) return vec2(0);
    const float v = (ap.x * ac.y - ap.y * ac.x) / doubled, w = (ab.x * ap.y - ab.y * ap.x) / doubled;
    return clamp(vec2(v, w), vec2(0), vec2(1));
}

/// The middle of a patch in the frame of its grid.
vec2 middle_of(const PatchShape& shape, const SurfaceGrid& grid) {
    vec2 middle(0);
    for (vec2 corner : shape.outline) middle += (corner - vec2(shape.low)) / float(shape.outline.size());
    return grid.lattice.low + (shape.outline.empty() ? 0.5f * vec2(shape.high - shape.low) : middle);
}

/// Weights of the second and third corner of a triangle of a point of its plane, which may lie beyond its edges.
vec2 barycentrics_of(const std::array<vec3, 3>& corners, vec3 point) {
    const glm::dvec3 a(corners[0]), ab = glm::dvec3(corners[1]) - a, ac = glm::dvec3(corners[2]) - a,
                                    ap = glm::dvec3(point) - a;
    const double bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac), pb = glm::dot(ap, ab),
                 pc = glm::dot(ap, ac), determinant = bb * cc - bc * bc;
    return vec2(float((cc * pb - bc * pc) / determinant), float((bb * pc - bc * pb) / determinant));
}

/// How much of the way from one point of a triangle to another lies in it; both by barycentrics.
float part_inside(vec2 from, vec2 to) {
    const vec3 start(1 - from.x - from.y, from), end(1 - to.x - to.y, to);
    float part = 1;
    for (int c = 0; c < 3; ++c)
        if (end[c] < 0) part = std::min(part, std::max(start[c], 0.0f) / std::max(start[c] - end[c], 1e-20f));
    return part;
}

/// Draws the points of a lattice towards the middle of their patch by a small part of a step, within their triangles,
/// so that rays that leave those on its border do not start in a wall that stands there. Not in slivers, which hold no
/// place exactly.
void draw_in(const Scene& scene, const SurfaceGrid& grid, vec2 middle, std::span<NodePoint> points) {
    const float wanted = drawn_in * std::max(grid.lattice.step.x, grid.lattice.step.y);
    for (NodePoint& point : points) {
        if (!point.exists()) continue;
        const std::array<vec3, 3> p = triangle_corners(scene, point.triangle);
        const vec3 product = edge_product(p[0], p[1], p[2]), edge = p[1] - p[0], other = p[2] - p[0];
        if (length(product) < 1e-3f * std::max(dot(edge, edge), dot(other, other))) continue;
        const vec2 b = point.barycentrics;
        const vec3 at = (1 - b.x - b.y) * p[0] + b.x * p[1] + b.y * p[2];
        vec3 way = position_of(grid, vec3(middle, position_in_grid(grid, at).z)) - at;
        way -= product * (dot(way, product) / dot(product, product));
        const float distance = length(way);
        if (!(distance > 0)) continue;
        const vec2 moved = barycentrics_of(p, at + way * std::min(wanted / distance, 1.0f));
        point.barycentrics = b + (moved - b) * part_inside(b, moved);
    }
}

/// Offers one triangle side to the nodes around it; where a patch is cut, only what lies inside its `outline`, in the
/// lattice's frame.
void place_nodes(const SurfaceLattice& lattice, const std::array<vec3, 3>& locals, uint triangle,
                 const std::vector<vec2>& outline, std::vector<NodePoint>& nodes) {
    const std::array<vec2, 3> corners{vec2(locals[0]), vec2(locals[1]), vec2(locals[2])};
    const vec2 low = min(corners[0], min(corners[1], corners[2])), high = max(corners[0], max(corners[1], corners[2]));
    const auto node = [](float value, uint count) { return uint(clamp(value, 0.0f, float(count - 1))); };
    const uint x0 = node(std::floor(low.x / lattice.step.x), lattice.columns),
               x1 = node(std::ceil(high.x / lattice.step.x), lattice.columns),
               y0 = node(std::floor(low.y / lattice.step.y), lattice.rows),
               y1 = node(std::ceil(high.y / lattice.step.y), lattice.rows);
    const float farthest2 = 1.01f * dot(lattice.step, lattice.step);  // the diagonal of a cell
    for (uint y = y0; y <= y1; ++y)
        for (uint x = x0; x <= x1; ++x) {
            NodePoint& point = nodes[lattice.first_node + y * lattice.columns + x];
            const vec2 at = vec2(float(x), float(y)) * lattice.step;
            const vec2 goal = outline.empty() ? at : nearest_in_outline(outline, at);
            vec2 nearest;
            const vec2 weights = nearest_barycentrics(corners[0] - goal, corners[1] - goal, corners[2] - goal, nearest);
            if (!outline.empty() && length(nearest_in_outline(outline, goal + nearest) - goal - nearest) >
                                        1e-3f * std::max(lattice.step.x, lattice.step.y))
                continue;
            nearest += goal - at;
            const float squared = dot(nearest, nearest);
            if (squared > farthest2) continue;
            const float distance2 =
                squared < 1e-6f * dot(lattice.step, lattice.step) ? 0 : squared;  // over the surface
            const float height =
                locals[0].z + weights.x * (locals[1].z - locals[0].z) + weights.y * (locals[2].z - locals[0].z);
            if (distance2 < point.distance2 || (distance2 == point.distance2 && height > point.height))
                point = {triangle, weights, distance2, height};
        }
}

}  // namespace

Nodes lay_nodes(const Scene& scene, const Partition& partition, PatchGrids surfaces) {
    const auto shape_of = [&](size_t m) -> const PatchShape& { return partition.shapes[surfaces.patches[m]]; };
    uint64_t count = 0;
    for (size_t m = 0; m < surfaces.grids.size(); ++m) {
        SurfaceLattice& lattice = surfaces.grids[m].lattice;
        lattice = fit_lattice(shape_of(m), surfaces.grids[m], partition.node_distances[surfaces.patches[m]]);
        lattice.first_node = uint(count);
        count += uint64_t(lattice.columns) * lattice.rows;
    }
    if (count * visibility_row_length(uint(scene.lights.size())) >= no_grid)
        throw Error("photon map: more than 2^32 lattice nodes; use a larger radius");
    std::vector<NodePoint> points(count);
    const SidesOfGrids sides(surfaces);
    parallel_for(surfaces.grids.size(), [&](size_t m) {
        const SurfaceGrid& grid = surfaces.grids[m];
        const SurfaceLattice& lattice = grid.lattice;
        const std::vector<vec2> outline = outline_in(shape_of(m), lattice);
        for (uint i = sides.starts[m]; i < sides.starts[m + 1]; ++i) {
            const uint triangle = sides.sides[i] / 2;
            std::array<vec3, 3> corners = triangle_corners(scene, triangle);
            for (vec3& corner : corners) corner = position_in_grid(grid, corner) - vec3(lattice.low, 0);
            place_nodes(lattice, corners, triangle, outline, points);
        }
        draw_in(scene, grid, middle_of(shape_of(m), grid),
                std::span(points).subspan(lattice.first_node, lattice.columns * lattice.rows));
    });
    return {std::move(surfaces), std::move(points)};
}

}  // namespace lw
