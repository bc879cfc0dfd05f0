// Look-ups in the photon map: the patch and cell of a point, and the coverage of a kernel there. One text for C++ and
// GLSL. The including scope provides the functions grid_at, cut_at, node_coverage, what grid.glsl needs, and the
// constant has_coverage. Needs photon_map.h; includes grid.glsl.

#include "grid.glsl"

/// The lower left node of the lattice cell that holds a point. Sets `f` to the place of the point in the cell, 0 to 1
/// along u and v. Points outside are moved to the border.
uint cell_node(SurfaceLattice lattice, vec3 local, LW_INOUT(vec2) f) LW_MEMBER {
    vec2 last = vec2(float(lattice.columns - 1u), float(lattice.rows - 1u));
    vec2 at = clamp((vec2(local.x, local.y) - lattice.low) / lattice.step, vec2(0.0f), last);
    vec2 base = min(floor(at), last - 1.0f);
    f = at - base;
    return lattice.first_node + uint(base.y) * lattice.columns + uint(base.x);
}

/// Where a point lies on its patch.
struct GridPlace {
    uint index;  // of the grid, or no_grid, when the other members mean nothing
    SurfaceGrid grid;
    vec3 local;  // u, v, h in the frame of the grid, m
    uint cell;   // lower left node of the cell of the lattice
    vec2 f;      // place in the cell, 0 to 1
};

/// The grid of a point on a surface whose grid or cut is `index`; no_grid where it has none.
uint behind_cuts(uint index, vec3 position) LW_MEMBER {
    while (is_cut(index)) index = behind_cut(cut_at(index & ~cut_bit), position);
    return index;
}

GridPlace place_on_grid(uint index, vec3 position) LW_MEMBER {
    GridPlace at;
    at.index = behind_cuts(index, position);
    at.grid = grid_at(at.index == no_grid ? 0u : at.index);  // any record that exists
    at.local = position_in_grid(at.grid, position);
    at.cell = cell_node(at.grid.lattice, at.local, at.f);
    return at;
}

/// Coverage of a kernel of `radius` m around a place, interpolated between the nodes; at least min_coverage.
float coverage_at(GridPlace at, float radius) LW_MEMBER {
    float fraction = radius / at.grid.radius;
    uint node = at.cell;
    uint above = node + at.grid.lattice.columns;
    float low = mix(unpack_coverage(node_coverage(node), fraction), unpack_coverage(node_coverage(node + 1u), fraction),
                    at.f.x);
    float high = mix(unpack_coverage(node_coverage(above), fraction),
                     unpack_coverage(node_coverage(above + 1u), fraction), at.f.x);
    return max(mix(low, high, at.f.y), min_coverage);
}

/// The coverage to divide an estimate by; 1 when the map has no coverage.
float covered_part(GridPlace at, float radius) LW_MEMBER { return has_coverage ? coverage_at(at, radius) : 1.0f; }

/// The same for a kernel of `radius` m on the grid of caustics of that surface. Kernels much smaller than the smallest
/// for which coverage is known hardly reach a border, so theirs tends to 1.
float caustic_coverage(GridPlace at, SurfaceGrid caustics, float radius) LW_MEMBER {
    if (!has_coverage || at.index == no_grid) return 1.0f;
    return mix(1.0f, coverage_at(at, radius), min(4.0f * radius / caustics.radius, 1.0f));
}
