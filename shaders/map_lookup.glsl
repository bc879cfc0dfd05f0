// Where a point of a surface lies in the photon map, and how much of a kernel there lies on surface. One text for C++
// and GLSL. The including scope provides the functions grid_at, cut_at, node_coverage and the constant has_coverage,
// and what grid.glsl needs, which this text includes.

#include "grid.glsl"

/// Where a point lies in a grid.
struct GridPlace {
    uint index;  // of the grid, or no_grid, then nothing else holds
    SurfaceGrid grid;
    vec3 local;  // u, v, h in the frame of the grid, m
    uint cell;   // the lattice cell, by the number of its lower left node
    vec2 f;      // place in the lattice cell, 0 to 1
};

/// The grid of a point of a surface whose grid or cut is `index`; no_grid where it has none.
uint behind_cuts(uint index, vec3 position) LW_MEMBER {
    while (is_cut(index)) index = behind_cut(cut_at(index & ~cut_bit), position);
    return index;
}

GridPlace place_on_grid(uint index, vec3 position) LW_MEMBER {
    GridPlace at;
    at.index = behind_cuts(index, position);
    at.grid = grid_at(at.index == no_grid ? 0u : at.index);  // anything, but there
    at.local = position_in_grid(at.grid, position);
    at.cell = lattice_cell_of(at.grid.lattice, at.local, at.f);
    return at;
}

/// Coverage of the kernel of `radius` around a place, between the lattice's nodes.
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

/// The part of the kernel of `radius` around a place that lies on surface light can reach; 1 where the map does not
/// know.
float covered_part(GridPlace at, float radius) LW_MEMBER { return has_coverage ? coverage_at(at, radius) : 1.0f; }

/// The same for a kernel on the grid of caustics of that surface: kernels much smaller than the coverage's least one
/// hardly reach a border.
float caustic_coverage(GridPlace at, SurfaceGrid caustics, float radius) LW_MEMBER {
    if (!has_coverage || at.index == no_grid) return 1.0f;
    return mix(1.0f, coverage_at(at, radius), min(4.0f * radius / caustics.radius, 1.0f));
}
