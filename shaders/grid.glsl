// Cells of the 2D grid of one patch, and the bandwidths that follow from the photons counted in them (paper, sections
// 2.1-2.2). One text for C++ and GLSL. The including scope provides the function cell_start and the constant
// neighbours; needs photon_map.h.

/// The grid cell of a point, column and row; it may lie beyond the grid. `local`: in the frame of the grid, m.
ivec2 grid_cell_of(vec3 local, SurfaceGrid grid) LW_MEMBER {
    return ivec2(int(floor(local.x / grid.cell_size)), int(floor(local.y / grid.cell_size)));
}

/// First and last reference of the cells [x0, x1] of row y, clipped to the grid.
uvec2 row_span(SurfaceGrid grid, int x0, int x1, int y) LW_MEMBER {
    if (y < 0 || y >= int(grid.rows) || x1 < 0 || x0 >= int(grid.columns)) return uvec2(0u, 0u);
    uint row = grid.first_cell + uint(y) * grid.columns;
    return uvec2(cell_start(row + uint(max(x0, 0))), cell_start(row + uint(min(x1, int(grid.columns) - 1)) + 1u));
}

/// True when the window of `ring` cells around `cell` covers the grid.
bool covers_grid(SurfaceGrid grid, ivec2 cell, int ring) LW_MEMBER {
    return cell.x - ring <= 0 && cell.y - ring <= 0 && cell.x + ring >= int(grid.columns) - 1 &&
           cell.y + ring >= int(grid.rows) - 1;
}

/// The first ring of cells around `cell` that meets the grid. Few photons make small grids of small cells: rings that
/// are empty for certain cost nothing.
int first_ring(SurfaceGrid grid, ivec2 cell) LW_MEMBER {
    ivec2 beyond = max(-cell, cell - ivec2(int(grid.columns) - 1, int(grid.rows) - 1));
    return max(max(beyond.x, beyond.y), 0);
}

/// The lattice cell of a point, by the number of its lower left node, and in `f` the place in the cell, 0 to 1 along u
/// and v. `local`: the point in the frame of the grid, m; one beyond the lattice is moved to its border.
uint lattice_cell_of(SurfaceLattice lattice, vec3 local, LW_INOUT(vec2) f) LW_MEMBER {
    vec2 last = vec2(float(lattice.columns - 1u), float(lattice.rows - 1u));
    vec2 at = clamp((vec2(local.x, local.y) - lattice.low) / lattice.step, vec2(0.0f), last);
    vec2 base = min(floor(at), last - 1.0f);
    f = at - base;
    return lattice.first_node + uint(base.y) * lattice.columns + uint(base.x);
}

/// Radius that is expected to hold k photons, from the counts of a growing window of cells.
float bandwidth_from_counts(SurfaceGrid grid, vec3 local) LW_MEMBER {
    ivec2 cell = grid_cell_of(local, grid);
    float wanted = 1.25f * float(neighbours);
    int last_ring = int(grid.radius / grid.cell_size) + 1;
    float count = 0.0f;
    float area = 0.0f;
    int ring = 0;
    for (; ring <= last_ring; ++ring) {
        count = 0.0f;
        int x0 = max(cell.x - ring, 0);
        int x1 = min(cell.x + ring, int(grid.columns) - 1);
        int y0 = max(cell.y - ring, 0);
        int y1 = min(cell.y + ring, int(grid.rows) - 1);
        for (int y = y0; y <= y1; ++y) {
            uvec2 span = row_span(grid, x0, x1, y);
            count += float(span.y - span.x);
        }
        area = float(max(x1 - x0 + 1, 1)) * float(max(y1 - y0 + 1, 1)) * grid.cell_size * grid.cell_size;
        if (count >= wanted || covers_grid(grid, cell, ring)) break;
    }
    if (count < wanted) return grid.radius;  // the grid ends where its photons do: their area says nothing
    return clamp(sqrt(float(neighbours) * area / (lw_pi * count)), min(0.5f * grid.cell_size, grid.radius),
                 grid.radius);
}

/// Radius that holds caustic_neighbours photons, from the counts of a growing window of cells. Few photons make small
/// grids of small cells: the window starts where it meets the grid and grows in proportion.
float caustic_radius(SurfaceGrid grid, vec3 local) LW_MEMBER {
    ivec2 cell = grid_cell_of(local, grid);
    ivec2 last = ivec2(int(grid.columns) - 1, int(grid.rows) - 1);
    int ring = first_ring(grid, cell);
    int last_ring = int(grid.radius / grid.cell_size) + 1;
    if (ring > last_ring) return grid.radius;
    float count = 0.0f;
    float area = 0.0f;
    for (;;) {
        int x0 = max(cell.x - ring, 0);
        int x1 = min(cell.x + ring, last.x);
        int y0 = max(cell.y - ring, 0);
        int y1 = min(cell.y + ring, last.y);
        count = 0.0f;
        for (int y = y0; y <= y1; ++y) {
            uvec2 span = row_span(grid, x0, x1, y);
            count += float(span.y - span.x);
        }
        area = float(x1 - x0 + 1) * float(y1 - y0 + 1) * grid.cell_size * grid.cell_size;
        if (count >= 1.25f * caustic_neighbours || ring > last_ring || covers_grid(grid, cell, ring)) break;
        ring += max(ring / 8, 1);
    }
    if (count < 1.0f) return grid.radius;
    return clamp(sqrt(caustic_neighbours * area / (lw_pi * count)), 0.02f * min(grid.cell_size, grid.radius),
                 grid.radius);
}
