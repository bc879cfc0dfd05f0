// Photon density estimation on the 2D grid of one map (paper, sections 2.1-2.2: Graglia, Sequeira, Mavromatis,
// Real-Time Walkthrough Rendering, 2012). One text for C++ and GLSL. The including scope provides the functions
// grid_at, is_cut (false for no_map), cell_start, photon_place, photon_flux, photon_direction, lamp_power, light_at,
// node_coverage, cell_light and the constants has_caustics, gather_mode, neighbours, heap_size, max_radius,
// inverse_flux_scale, inverse_irradiance_scale, has_directions, has_coverage, has_followed. Needs photon_map.h and
// bsdf.glsl.

Gathered no_light() LW_MEMBER {
    Gathered nothing;
    nothing.radiance = vec3(0.0f);
    nothing.irradiance = vec3(0.0f);
    nothing.radius = max_radius;
    nothing.photons = 0.0f;
    return nothing;
}

/// True for a photon that no followed ray can stand for: a ray may meet a mirrored mesh lamp, but no mirrored point or
/// sun.
bool is_unseen_by_rays(Surface s, PhotonPlace photon) LW_MEMBER {
    if (!has_caustics || path_of(photon) != path_caustic || s.roughness * s.roughness < min_alpha) return false;
    return light_at(light_of(photon)).type != light_mesh;
}

/// True where rays bring what the specular lobe reflects, so that estimates have to leave it out.
bool leaves_lobe_out(Surface s) LW_MEMBER { return has_followed && (s.flags & lobe_is_followed) != 0u; }

/// Adds photon `i` of the record `place`, weighted by `kernel`, to sums that add_up() completes.
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
    float tilt = clamp(cos_shading / cos_geometric, 0.0f, 2.0f);  // irradiance on the shading normal's plane
    BrdfParts f = brdf_parts(s, n_shading, to_view, to_light);
    sum.radiance += flux * tilt * (lobe_left_out ? f.diffuse : f.diffuse + f.specular);
}

/// Brings sums of flux to irradiance and radiance; `peak` (1/m2) is what all kernels have in common.
void add_up(float peak, Surface s, vec3 n_shading, vec3 to_view, LW_INOUT(Gathered) sum) LW_MEMBER {
    float scale = min(peak * inverse_flux_scale, 1e30f);  // a number, however small the kernel
    sum.irradiance *= scale;
    sum.radiance *= scale;
    if (!has_directions) sum.radiance = sum.irradiance * eval_brdf(s, n_shading, to_view, n_shading, true);
}

ivec2 cell_of(vec3 local, SurfaceGrid grid) LW_MEMBER {
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

/// Exact k nearest photons with a bounded max-heap, nearest cells first; sum over the k-1 nearer ones / (pi r_k^2),
/// the unbiased estimate (Garcia et al. 2012). With fewer than k photons inside the map's radius: all of them over its
/// disc.
Gathered gather_exact(SurfaceGrid grid, vec3 local, Surface s, vec3 n_geometric, vec3 n_shading,
                      vec3 to_view) LW_MEMBER {
    float heap_distance[heap_size];
    uint heap_photon[heap_size];
    uint k = min(neighbours, heap_size);
    uint count = 0u;
    float bound = grid.radius * grid.radius;
    ivec2 cell = cell_of(local, grid);
    for (int ring = first_ring(grid, cell);; ++ring) {
        for (int y = cell.y - ring; y <= cell.y + ring; ++y) {
            bool whole_row = y == cell.y - ring || y == cell.y + ring;
            int step = whole_row ? 1 : 2 * ring;
            for (int x = cell.x - ring; x <= cell.x + ring; x += max(step, 1)) {
                uvec2 span = row_span(grid, x, whole_row ? cell.x + ring : x, y);
                for (uint i = span.x; i < span.y; ++i) {
                    vec3 d = place_in_grid(photon_place(i), grid) - local;
                    float d2 = dot(d, d);
                    if (d2 >= bound || !on_same_surface(d.z, d2, max_radius)) continue;
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
    Gathered sum;
    sum.radiance = vec3(0.0f);
    sum.irradiance = vec3(0.0f);
    bool full = count == k;
    float radius_squared = max(full ? heap_distance[0] : grid.radius * grid.radius, 1e-12f * grid.radius * grid.radius);
    sum.radius = sqrt(radius_squared);
    sum.photons = float(full ? count - 1u : count);
    for (uint j = full ? 1u : 0u; j < count; ++j)
        add_photon(heap_photon[j], photon_place(heap_photon[j]), 1.0f, s, n_geometric, n_shading, to_view, sum);
    add_up(1.0f / (lw_pi * radius_squared), s, n_shading, to_view, sum);
    return sum;
}

/// Radius that is expected to hold k photons, from the counts of a growing window of cells.
float bandwidth_from_counts(SurfaceGrid grid, vec3 local) LW_MEMBER {
    ivec2 cell = cell_of(local, grid);
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

/// One pass with an Epanechnikov kernel 2 / (pi r^2) (1 - d^2 / r^2) (Silverman 1986), no heap.
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
        Gathered row = nothing;  // apart, so that sums of millions do not drift
        for (uint i = span.x; i < span.y; ++i) {
            PhotonPlace place = photon_place(i);
            vec3 d = place_in_grid(place, grid) - local;
            float d2 = dot(d, d);
            if (d2 >= r2 || !on_same_surface(d.z, d2, max_radius)) continue;
            row.photons += 1.0f;
            add_photon(i, place, 1.0f - d2 * inverse_r2, s, n_geometric, n_shading, to_view, row);
        }
        sum.radiance += row.radiance;
        sum.irradiance += row.irradiance;
        sum.photons += row.photons;
    }
    add_up(2.0f / (lw_pi * r2), s, n_shading, to_view, sum);
    return sum;
}

/// The node below and left of a point, and in `f` where the point lies in the cell it begins.
uint cell_node(SurfaceLattice lattice, vec3 local, LW_INOUT(vec2) f) LW_MEMBER {
    vec2 last = vec2(float(lattice.columns - 1u), float(lattice.rows - 1u));
    vec2 at = clamp((vec2(local.x, local.y) - lattice.low) / lattice.step, vec2(0.0f), last);
    vec2 base = min(floor(at), last - 1.0f);
    f = at - base;
    return lattice.first_node + uint(base.y) * lattice.columns + uint(base.x);
}

vec3 position_in_grid(SurfaceGrid grid, vec3 position) LW_MEMBER {
    vec3 offset = position - grid.origin;
    return vec3(dot(offset, grid.u_axis), dot(offset, grid.v_axis), dot(offset, grid.normal));
}

/// The part of the corners of a cell whose bits 0 to 3 are set, as seen from `f` in the cell.
float corners_set(uint bits, vec2 f) LW_MEMBER {
    vec4 set = vec4(float(bits & 1u), float((bits >> 1) & 1u), float((bits >> 2) & 1u), float((bits >> 3) & 1u));
    return mix(mix(set.x, set.y, f.x), mix(set.z, set.w, f.x), f.y);
}

/// Where a point lies on a map.
struct MapPlace {
    uint map;  // or no_map, then nothing else holds
    SurfaceGrid grid;
    vec3 local;  // u, v, h in the frame of the grid, m
    uint cell;   // the lower left node of the cell of the lattice
    vec2 f;      // where in the cell
};

/// The map of a point of a surface whose map may be cut.
uint map_at(uint map, vec3 position) LW_MEMBER {
    while (is_cut(map)) map = behind_cut(grid_at(map), position);
    return map;
}

MapPlace place_on(uint map, vec3 position) LW_MEMBER {
    MapPlace at;
    at.map = map_at(map, position);
    at.grid = grid_at(at.map == no_map ? 0u : at.map);  // anything, but there
    at.local = position_in_grid(at.grid, position);
    at.cell = cell_node(at.grid.lattice, at.local, at.f);
    return at;
}

/// The part of the kernel of `radius` around a place that lies on surface light can reach; between the lattice's nodes.
float coverage_at(MapPlace at, float radius) LW_MEMBER {
    float fraction = radius / at.grid.radius;
    uint node = at.cell;
    uint above = node + at.grid.lattice.columns;
    float low = mix(unpack_coverage(node_coverage(node), fraction), unpack_coverage(node_coverage(node + 1u), fraction),
                    at.f.x);
    float high = mix(unpack_coverage(node_coverage(above), fraction),
                     unpack_coverage(node_coverage(above + 1u), fraction), at.f.x);
    return max(mix(low, high, at.f.y), min_coverage);
}

/// The irradiance computed ahead at the corners of the cell, all lamps at their present power; light from all sides
/// alike for the BRDF.
Gathered gather_cached(MapPlace at, Surface s, vec3 n_shading, vec3 to_view) LW_MEMBER {
    uvec4 corners = cell_light(at.cell);
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

/// Reflected radiance and irradiance at surface `s` from the photons around a place; zero when it is on no map.
/// n_geometric and n_shading are turned to the viewer.
Gathered gather_photons(MapPlace at, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view) LW_MEMBER {
    if (at.map == no_map) return no_light();
    if (gather_mode == gather_mode_cached) return gather_cached(at, s, n_shading, to_view);
    if (gather_mode == gather_mode_exact) return gather_exact(at.grid, at.local, s, n_geometric, n_shading, to_view);
    Gathered sum = gather_smooth(at.grid, at.local, s, n_geometric, n_shading, to_view);
    if (!has_coverage) return sum;
    float covered = coverage_at(at, sum.radius);
    sum.radiance /= covered;
    sum.irradiance /= covered;
    return sum;
}
