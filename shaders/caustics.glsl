// Caustics: light that lamps send by mirrors and smooth glass alone, whose photons lie in grids of their own. They are
// gathered at each point with a small bandwidth, so that they stay sharp; in the cached mode the light of the lattice
// cells holds smooth caustics already. One text for C++ and GLSL; needs gather.glsl, the functions caustic_grid_of,
// lattice_row_entry and the constants has_caustics, has_smooth_caustics, has_visible_lamps, light_count.

/// The part of the caustics at a place, 0 to 1, that the light of its lattice cell does not hold.
float caustics_left(GridPlace at) LW_MEMBER {
    if (!has_smooth_caustics || !has_visible_lamps || gather_mode != gather_mode_cached || at.index == no_grid)
        return 1.0f;
    return 1.0f - corners_set(lattice_row_entry(at.cell * lattice_row_length(light_count, true)), at.f);
}

/// Adds the part `left` of the caustic light at a surface of `triangle` whose other light comes from the place `at`.
void add_caustics(uint triangle, bool front, float left, GridPlace at, Surface s, vec3 n_geometric, vec3 n_shading,
                  vec3 to_view, LW_INOUT(Gathered) light) LW_MEMBER {
    uint own = left > 0.0f ? behind_cuts(caustic_grid_of(triangle, front), s.position) : no_grid;
    if (own == no_grid) return;
    SurfaceGrid grid = grid_at(own);
    vec3 local = position_in_grid(grid, s.position);
    float radius = caustic_radius(grid, local);
    float r2 = radius * radius;
    float peak = kernel_peak(r2) / caustic_coverage(at, grid, radius);
    Gathered sum = no_light();
    int y1 = min(int(floor((local.y + radius) / grid.cell_size)), int(grid.rows) - 1);
    for (int y = max(int(floor((local.y - radius) / grid.cell_size)), 0); y <= y1; ++y) {
        uvec2 span = row_span(grid, int(floor((local.x - radius) / grid.cell_size)),
                              int(floor((local.x + radius) / grid.cell_size)), y);
        for (uint i = span.x; i < span.y; ++i) {
            PhotonPlace place = photon_place(i);
            vec3 d = place_in_grid(place, grid) - local;
            float d2 = dot(d, d);
            if (d2 >= r2 || !on_same_surface(d.z, d2, grid.radius)) continue;
            add_photon(i, place, kernel_shape(d2 / r2), s, n_geometric, n_shading, to_view, sum);
        }
    }
    add_up(peak, s, n_shading, to_view, sum);
    light.radiance += left * sum.radiance;
    light.irradiance += left * sum.irradiance;
}
