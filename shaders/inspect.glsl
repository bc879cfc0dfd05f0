// Data about the smooth estimate at a point, for the views that show them: bandwidth, number of photons, noise, the
// photons themselves. One text for C++ and GLSL; needs shade.glsl.

/// bandwidth, m, and number of photons of the smooth estimate; standard error of the illuminance over its value
/// (photons have noise, direct light has none); and 1 + the lamp of the photon to draw at the point, 0 where none is
/// near.
struct Inspected {
    float bandwidth;
    float photons;
    float relative_error;
    float dot_lamp;
};

/// 1 + the lamp of the nearest photon within `reach` m of a point; 0 when there is none.
float photon_nearby(SurfaceGrid grid, vec3 local, float reach) LW_MEMBER {
    float nearest = reach * reach;
    float lamp = 0.0f;
    ivec2 low = grid_cell_of(local - vec3(reach, reach, 0.0f), grid);
    ivec2 high = grid_cell_of(local + vec3(reach, reach, 0.0f), grid);
    for (int y = low.y; y <= high.y; ++y) {
        uvec2 span = row_span(grid, low.x, high.x, y);
        for (uint i = span.x; i < span.y; ++i) {
            vec3 d = place_in_grid(photon_place(i), grid) - local;
            if (dot(d, d) >= nearest) continue;
            nearest = dot(d, d);
            lamp = 1.0f + float(light_of(photon_place(i)));
        }
    }
    return lamp;
}

Inspected inspect(Seen seen, float dot_reach, uint seed) LW_MEMBER {
    Inspected result;
    result.bandwidth = 0.0f;
    result.photons = 0.0f;
    result.relative_error = 0.0f;
    result.dot_lamp = 0.0f;
    if (seen.at.index == no_grid) return result;
    SurfaceGrid grid = seen.at.grid;
    vec3 local = seen.at.local;
    float radius = bandwidth_from_counts(grid, local);
    float r2 = radius * radius;
    vec3 weights = luminance_weights * (kernel_peak(r2) * inverse_flux_scale);
    float sum = 0.0f;
    float squares = 0.0f;
    ivec2 low = grid_cell_of(local - vec3(radius, radius, 0.0f), grid);
    ivec2 high = grid_cell_of(local + vec3(radius, radius, 0.0f), grid);
    for (int y = low.y; y <= high.y; ++y) {
        uvec2 span = row_span(grid, low.x, high.x, y);
        for (uint i = span.x; i < span.y; ++i) {
            vec3 d = place_in_grid(photon_place(i), grid) - local;
            float d2 = dot(d, d);
            if (d2 >= r2 || !on_same_surface(d.z, d2, grid.radius)) continue;
            vec3 flux = unpack_rgb9e5(photon_flux(i)) * lamp_power(light_of(photon_place(i)));
            float lux = dot(flux, weights) * kernel_shape(d2 / r2);
            sum += lux;
            squares += lux * lux;
            result.photons += 1.0f;
        }
    }
    float coverage = covered_part(seen.at, radius);
    Gathered direct = no_light();
    for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
        add_direct(seen.at, pair, seen.surface, seen.n_geometric, seen.n_geometric, seen.to_eye, first_points(seed),
                   direct);
    float total = sum / coverage + luminance(direct.irradiance);
    result.bandwidth = radius;
    result.relative_error = total > 0.0f ? sqrt(squares) / coverage / total : 0.0f;
    result.dot_lamp = photon_nearby(grid, local, min(dot_reach, grid.radius));
    return result;
}
