// Photon density estimation on the 2D grid of one patch (paper, sections 2.1-2.2: Graglia, Sequeira, Mavromatis,
// Real-Time Walkthrough Rendering, 2012). One text for C++ and GLSL. The including scope provides the functions
// photon_place, photon_flux, photon_direction, lamp_power, light_at, lattice_light and the constants has_caustics,
// gather_mode, neighbours, heap_size, inverse_flux_scale, inverse_irradiance_scale, has_directions,
// has_coverage, has_followed. Needs map_lookup.glsl and bsdf.glsl.

Gathered no_light() LW_MEMBER {
    Gathered nothing;
    nothing.radiance = vec3(0.0f);
    nothing.irradiance = vec3(0.0f);
    nothing.radius = 0.0f;
    nothing.photons = 0.0f;
    return nothing;
}

/// True for a caustic photon of a point or sun. Followed rays cannot find its light, as they meet mirrored mesh lamps
/// but no mirrored points; so the estimate keeps its specular part.
bool is_unseen_by_rays(Surface s, PhotonPlace photon) LW_MEMBER {
    if (!has_caustics || path_of(photon) != path_caustic || s.roughness * s.roughness < min_alpha) return false;
    return !has_surface(light_at(light_of(photon)).type);
}

/// True where followed rays bring the light of the specular lobe, so that estimates must leave it out.
bool leaves_lobe_out(Surface s) LW_MEMBER { return has_followed && (s.flags & lobe_is_followed) != 0u; }

/// Adds photon `i`, whose place record is `place`, to `sum`. `kernel`: its kernel weight without the common factor,
/// which add_up() applies.
void add_photon(uint i, PhotonPlace place, float kernel, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
                LW_INOUT(Gathered) sum) LW_MEMBER {
    vec3 flux = unpack_rgb9e5(photon_flux(i)) * lamp_power(light_of(place)) * kernel;
    sum.irradiance += flux;
    if (!has_directions) return;
    bool lobe_left_out = leaves_lobe_out(s) && !is_unseen_by_rays(s, place);
    s.roughness = max(s.roughness, min_gathered_roughness);
    vec3 to_light = unpack_direction(photon_direction(i));
    float cos_shading = dot(n_shading, to_light);
    float cos_geometric = max(dot(n_geometric, to_light), 0.05f);
    float tilt = clamp(cos_shading / cos_geometric, 0.0f, 2.0f);  // turns irradiance to the plane of the shading normal
    BrdfParts f = brdf_parts(s, n_shading, to_view, to_light);
    sum.radiance += flux * tilt * (lobe_left_out ? f.diffuse : f.diffuse + f.specular);
}

/// Completes the sums of add_photon(): multiplies them by `peak`, the common factor of the kernel weights, 1/m2.
void add_up(float peak, Surface s, vec3 n_shading, vec3 to_view, LW_INOUT(Gathered) sum) LW_MEMBER {
    float scale = min(peak * inverse_flux_scale, 1e30f);  // finite, however small the kernel
    sum.irradiance *= scale;
    sum.radiance *= scale;
    if (!has_directions) sum.radiance = sum.irradiance * eval_brdf(s, n_shading, to_view, n_shading, true);
}

/// Exact k nearest photons with a bounded max-heap, nearest cells first; sum over the k-1 nearer ones / (pi r_k^2),
/// the unbiased estimate (Garcia et al. 2012). With fewer than k photons inside the grid's radius: all of them over its
/// disc.
Gathered gather_exact(SurfaceGrid grid, vec3 local, Surface s, vec3 n_geometric, vec3 n_shading,
                      vec3 to_view) LW_MEMBER {
    float heap_distance[heap_size];
    uint heap_photon[heap_size];
    uint k = min(neighbours, heap_size);
    uint count = 0u;
    float bound = grid.radius * grid.radius;
    ivec2 cell = grid_cell_of(local, grid);
    for (int ring = first_ring(grid, cell);; ++ring) {
        for (int y = cell.y - ring; y <= cell.y + ring; ++y) {
            bool whole_row = y == cell.y - ring || y == cell.y + ring;
            int step = whole_row ? 1 : 2 * ring;
            for (int x = cell.x - ring; x <= cell.x + ring; x += max(step, 1)) {
                uvec2 span = row_span(grid, x, whole_row ? cell.x + ring : x, y);
                for (uint i = span.x; i < span.y; ++i) {
                    vec3 d = place_in_grid(photon_place(i), grid) - local;
                    float d2 = dot(d, d);
                    if (d2 >= bound || !on_same_surface(d.z, d2, grid.radius)) continue;
                    uint hole;
                    if (count < k) {
                        hole = count++;
                        while (hole > 0u && heap_distance[(hole - 1u) / 2u] < d2) {
                            heap_distance[hole] = heap_distance[(hole - 1u) / 2u];
                            heap_photon[hole] = heap_photon[(hole - 1u) / 2u];
                            hole = (hole - 1u) / 2u;
                        }
                    } else {
                        hole = 0u;
                        for (uint child = 1u; child < k; child = 2u * hole + 1u) {
                            if (child + 1u < k && heap_distance[child + 1u] > heap_distance[child]) ++child;
                            if (heap_distance[child] <= d2) break;
                            heap_distance[hole] = heap_distance[child];
                            heap_photon[hole] = heap_photon[child];
                            hole = child;
                        }
                    }
                    heap_distance[hole] = d2;
                    heap_photon[hole] = i;
                    if (count == k) bound = heap_distance[0];
                }
                if (whole_row) break;
            }
        }
        float left =
            min(local.x - float(cell.x - ring) * grid.cell_size, local.y - float(cell.y - ring) * grid.cell_size);
        float right = min(float(cell.x + ring + 1) * grid.cell_size - local.x,
                          float(cell.y + ring + 1) * grid.cell_size - local.y);
        float reached = max(min(left, right), 0.0f);
        if (reached * reached >= bound || covers_grid(grid, cell, ring)) break;
    }
    Gathered sum = no_light();
    bool full = count == k;
    float radius_squared = max(full ? heap_distance[0] : grid.radius * grid.radius, 1e-12f * grid.radius * grid.radius);
    sum.radius = sqrt(radius_squared);
    sum.photons = float(full ? count - 1u : count);
    for (uint j = full ? 1u : 0u; j < count; ++j)
        add_photon(heap_photon[j], photon_place(heap_photon[j]), 1.0f, s, n_geometric, n_shading, to_view, sum);
    add_up(1.0f / (lw_pi * radius_squared), s, n_shading, to_view, sum);
    return sum;
}

/// The smooth mode: one pass over the photons within the bandwidth, with the kernel of kernel.h and without a heap.
Gathered gather_smooth(SurfaceGrid grid, vec3 local, Surface s, vec3 n_geometric, vec3 n_shading,
                       vec3 to_view) LW_MEMBER {
    Gathered nothing = no_light();
    Gathered sum = nothing;
    sum.radius = bandwidth_from_counts(grid, local);
    float r2 = sum.radius * sum.radius;
    float inverse_r2 = 1.0f / r2;
    int y1 = int(floor((local.y + sum.radius) / grid.cell_size));
    for (int y = int(floor((local.y - sum.radius) / grid.cell_size)); y <= y1; ++y) {
        float below = float(y) * grid.cell_size - local.y;
        float dy = max(max(below, -below - grid.cell_size), 0.0f);
        float half_width = sqrt(max(r2 - dy * dy, 0.0f));
        int x0 = int(floor((local.x - half_width) / grid.cell_size));
        int x1 = int(floor((local.x + half_width) / grid.cell_size));
        uvec2 span = row_span(grid, x0, x1, y);
        Gathered row = nothing;  // summed by rows, so that rounding errors of millions of photons stay small
        for (uint i = span.x; i < span.y; ++i) {
            PhotonPlace place = photon_place(i);
            vec3 d = place_in_grid(place, grid) - local;
            float d2 = dot(d, d);
            if (d2 >= r2 || !on_same_surface(d.z, d2, grid.radius)) continue;
            row.photons += 1.0f;
            add_photon(i, place, kernel_shape(d2 * inverse_r2), s, n_geometric, n_shading, to_view, row);
        }
        sum.radiance += row.radiance;
        sum.irradiance += row.irradiance;
        sum.photons += row.photons;
    }
    add_up(kernel_peak(r2), s, n_shading, to_view, sum);
    return sum;
}

/// The irradiance computed ahead at the corners of the cell, all lamps at their present power; light from all sides
/// alike for the BRDF.
Gathered gather_cached(GridPlace at, Surface s, vec3 n_shading, vec3 to_view) LW_MEMBER {
    uvec4 corners = lattice_light(at.cell);
    vec3 low = mix(unpack_rgb9e5(corners.x), unpack_rgb9e5(corners.y), at.f.x);
    vec3 high = mix(unpack_rgb9e5(corners.z), unpack_rgb9e5(corners.w), at.f.x);
    Gathered sum;
    sum.irradiance = mix(low, high, at.f.y) * inverse_irradiance_scale;
    float nv = max(dot(n_shading, to_view), 0.0f);
    if (has_directions)
        sum.radiance =
            sum.irradiance * (leaves_lobe_out(s) ? diffuse_albedo_towards(s, nv) : albedo_towards(s, nv)) / lw_pi;
    else
        sum.radiance = sum.irradiance * eval_brdf(s, n_shading, to_view, n_shading, true);
    sum.radius = 0.0f;
    sum.photons = 0.0f;
    return sum;
}

/// Reflected radiance and irradiance at surface `s` from the photons around a place; zero when it is in no grid.
/// n_geometric and n_shading are turned to the viewer.
Gathered gather_photons(GridPlace at, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view) LW_MEMBER {
    if (at.index == no_grid) return no_light();
    if (gather_mode == gather_mode_cached) return gather_cached(at, s, n_shading, to_view);
    if (gather_mode == gather_mode_exact) return gather_exact(at.grid, at.local, s, n_geometric, n_shading, to_view);
    Gathered sum = gather_smooth(at.grid, at.local, s, n_geometric, n_shading, to_view);
    float covered = covered_part(at, sum.radius);
    sum.radiance /= covered;
    sum.irradiance /= covered;
    return sum;
}
