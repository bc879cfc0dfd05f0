// Light at what each pixel sees: the photons of the map on the visible side of the triangle, through the BRDF, direct
// light by shadow rays, and the surface's own glow. Writes radiance (cd/m2) and illuminance (lux). A first dispatch
// looks at the photons and lists the pixels that need rays for a second one: a processor that runs both sides of a
// branch pays for rays only where there are any.
#include "color.h"
#include "resident.glsl"

layout(local_size_x = gather_group_side, local_size_y = gather_group_side) in;
layout(push_constant, scalar) uniform Push { Frame frame; };

layout(set = 0, binding = binding_lights, scalar) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = binding_lamp_powers) uniform textureBuffer lamp_powers;
layout(set = 0, binding = binding_emitters, scalar) readonly buffer Emitters { Emitter emitters[]; };
layout(set = 0, binding = binding_caustic_grids) uniform utextureBuffer caustic_grids;
layout(set = 0, binding = binding_grids) uniform utextureBuffer grids;
layout(set = 0, binding = binding_cuts) uniform utextureBuffer cuts;
layout(set = 0, binding = binding_cell_starts) uniform utextureBuffer cell_starts;
layout(set = 0, binding = binding_places) uniform utextureBuffer places[max_chunks];
layout(set = 0, binding = binding_fluxes) uniform utextureBuffer fluxes[max_chunks];
layout(set = 0, binding = binding_directions) uniform utextureBuffer directions[max_chunks];
layout(set = 0, binding = binding_coverage) uniform utextureBuffer coverage;
layout(set = 0, binding = binding_lattice_light) uniform utextureBuffer light_of_lattices;
layout(set = 0, binding = binding_lattice_rows) uniform utextureBuffer rows_of_lattices;
layout(set = 0, binding = binding_shadow_masks) uniform utextureBuffer shadow_masks;
layout(set = 0, binding = binding_bvh_triangles) uniform utextureBuffer bvh_triangles;
#ifdef LW_RAY_QUERIES
layout(set = 0, binding = binding_acceleration) uniform accelerationStructureEXT acceleration;
#else
layout(set = 0, binding = binding_bvh_nodes) uniform utextureBuffer bvh_nodes;
#endif

layout(set = 1, binding = binding_visibility) uniform utexture2D visibility;
layout(set = 1, binding = binding_radiance, scalar) buffer Radiance { vec4 radiance_illuminance[]; };
layout(set = 1, binding = binding_ray_lists, scalar) buffer RayLists { RayPixels ray_lists[]; };
layout(set = 1, binding = binding_followed, scalar) buffer FollowedPaths { Followed followed[]; };
layout(set = 1, binding = binding_ray_pixels, scalar) buffer ListedPixels { uint listed_pixels[]; };

#define neighbours frame.neighbours
#define inverse_flux_scale frame.inverse_flux_scale
#define ray_epsilon frame.ray_epsilon
#define scene_size frame.scene_size
#define shadow_rays frame.shadow_rays
#define inverse_irradiance_scale frame.inverse_irradiance_scale
#define lobe_paths unpack_following(frame.following).paths
#define light_count uint(lights.length())

// Constant indices only: the arrays of buffers need no dynamic indexing, and one chunk costs no branch.
#define LW_RECORD(ARRAY, i)                                              \
    if (chunks == 1u) return texelFetch(ARRAY[0], int(i));               \
    int within = int(i & ((1u << chunk_shift) - 1u));                    \
    uint chunk = i >> chunk_shift;                                       \
    if (chunks > 3u && chunk == 3u) return texelFetch(ARRAY[3], within); \
    if (chunks > 2u && chunk == 2u) return texelFetch(ARRAY[2], within); \
    return chunk == 1u ? texelFetch(ARRAY[1], within) : texelFetch(ARRAY[0], within);
uvec4 place_record(uint i){LW_RECORD(places, i)} uvec4 flux_record(uint i){LW_RECORD(fluxes, i)} uvec4
    direction_record(uint i){LW_RECORD(directions, i)}

PhotonPlace photon_place(uint i) {
    uvec4 record = place_record(i);
    return PhotonPlace(record.x, record.y);
}
uint photon_flux(uint i) { return flux_record(i).x; }
uint photon_direction(uint i) { return direction_record(i).x; }

SurfaceGrid grid_at(uint index) {
    int first = int(index * surface_grid_texels);
    uvec4 t[surface_grid_texels];
    for (int i = 0; i < int(surface_grid_texels); ++i) t[i] = texelFetch(grids, first + i);
    SurfaceGrid grid;
    grid.origin = uintBitsToFloat(t[0].xyz);
    grid.cell_size = uintBitsToFloat(t[0].w);
    grid.u_axis = uintBitsToFloat(t[1].xyz);
    grid.columns = t[1].w;
    grid.v_axis = uintBitsToFloat(t[2].xyz);
    grid.rows = t[2].w;
    grid.normal = uintBitsToFloat(t[3].xyz);
    grid.first_cell = t[3].w;
    grid.quantum = uintBitsToFloat(t[4].xyz);
    grid.h_origin = uintBitsToFloat(t[4].w);
    grid.radius = uintBitsToFloat(t[5].x);
    grid.lattice.low = uintBitsToFloat(t[5].yz);
    grid.lattice.step = uintBitsToFloat(uvec2(t[5].w, t[6].x));
    grid.lattice.columns = t[6].y;
    grid.lattice.rows = t[6].z;
    grid.lattice.first_node = t[6].w;
    return grid;
}

Cut cut_at(uint i) {
    uvec4 first = texelFetch(cuts, int(cut_texels * i));
    uvec4 second = texelFetch(cuts, int(cut_texels * i) + 1);
    return Cut(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w);
}

#ifndef LW_RAY_QUERIES
#define bvh_node_count (uint(textureSize(bvh_nodes)) / 2u)
BvhNode bvh_node_at(uint i) {
    uvec4 low = texelFetch(bvh_nodes, int(2u * i));
    uvec4 high = texelFetch(bvh_nodes, int(2u * i + 1u));
    return BvhNode(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}
#endif

uint bvh_triangle_at(uint i) { return texelFetch(bvh_triangles, int(i)).x; }

uint grid_of(uint triangle, bool front) {
    uvec4 record = texelFetch(triangles, int(triangle));
    return front ? record.x : record.y;
}

uint caustic_grid_of(uint triangle, bool front) {
    uvec4 record = texelFetch(caustic_grids, int(triangle));
    return front ? record.x : record.y;
}

uint cell_start(uint cell) { return texelFetch(cell_starts, int(cell)).x; }

uint node_coverage(uint node) { return texelFetch(coverage, int(node)).x; }

uvec4 lattice_light(uint cell) { return texelFetch(light_of_lattices, int(cell)); }

uint lattice_row_entry(uint i) { return texelFetch(rows_of_lattices, int(i)).x; }

uvec4 shadow_mask(uint i) { return texelFetch(shadow_masks, int(i)); }

vec3 lamp_power(uint light) { return texelFetch(lamp_powers, int(2u * light)).xyz; }

vec3 lamp_factor(uint light) { return texelFetch(lamp_powers, int(2u * light + 1u)).xyz; }

Light light_at(uint i) { return lights[i]; }

#include "surface.glsl"
#include "bsdf.glsl"
#include "map_lookup.glsl"
#include "gather.glsl"
#include "caustics.glsl"
#ifdef LW_RAY_QUERIES
#include "ray_queries.glsl"
#else
#include "rays.glsl"
#endif
#include "profile.glsl"
#include "lights.glsl"
#include "direct.glsl"
#include "shade.glsl"
#include "follow.glsl"
#include "inspect.glsl"

void list_pixel(uint pixel, uint list) {
    uint place = atomicAdd(ray_lists[list].count, 1u);
    listed_pixels[list * frame.width * frame.height + place] = pixel;
}

/// The list whose pixels this dispatch is for.
uint list_of_dispatch() {
    return stage == stage_rays ? frame.ray_pair : ray_pairs(light_count) + unpack_following(frame.following).branch;
}

/// The pixel of this invocation, or one beyond the picture.
uint pixel_to_shade() {
    uint pixels = frame.width * frame.height;
    if (stage != stage_photons || of_followed) {
        uint list = list_of_dispatch();
        uint place = gl_WorkGroupID.x * gather_group_side * gather_group_side + gl_LocalInvocationIndex;
        return place < ray_lists[list].count ? listed_pixels[list * pixels + place] : pixels;
    }
    uvec2 xy = gl_GlobalInvocationID.xy;
    return xy.x < frame.width && xy.y < frame.height ? xy.y * frame.width + xy.x : pixels;
}

/// What the estimate of a pixel stands on; the photons' dots are two pixels wide.
vec4 inspect_pixel(Seen seen, uint seed) {
    float pixel_metres =
        length(frame.camera_position - seen.surface.position) * 2.0f / (frame.projection.y * float(frame.height));
    Inspected i = inspect(seen, pixel_metres, seed);
    return vec4(i.bandwidth, i.photons, i.relative_error, i.dot_lamp);
}

Seen seen_by(uint pixel) {
    uvec4 visible = texelFetch(visibility, ivec2(pixel % frame.width, pixel / frame.width), 0);
    return marked(see(visible.x, uintBitsToFloat(visible.yz), frame.camera_position));
}

uvec2 place_of(uint pixel) { return uvec2(pixel % frame.width, pixel / frame.width); }

/// Follows one path of a pixel to where photons and rays are gathered next.
void follow_pixel(uint pixel) {
    Following following = unpack_following(frame.following);
    PathNumbers numbers = path_numbers(place_of(pixel), following, frame.sample_index);
    ViewRay ray = no_ray();
    Followed before = followed[pixel];
    uint illuminance_flag = 0u;
    if (following.depth == 0u) {
        Seen seen = seen_by(pixel);
        ray = first_ray(seen, following.branch, numbers);
        if (following.branch == branch_through && is_followed_through(seen))
            illuminance_flag = followed_gives_illuminance;
    } else {
        if (before.triangle == no_triangle || (before.flags & followed_goes_on) == 0u) {
            followed[pixel].triangle = no_triangle;
            return;
        }
        ray = reflected_ray(see_followed(before), vec3(0.0f), lobe_numbers(numbers, 0u));
        ray.weight *= before.weight;
    }
    PathEnd end = follow(ray, numbers, following.depth + 1u == max_lobes);
    end.at.flags |= illuminance_flag;
    followed[pixel] = end.at;
    if (luminance(end.glow) > 0.0f)
        radiance_illuminance[pixel].xyz += end.glow * frame.sample_weight / float(following.paths);
}

/// Lists a pixel for each pair of lamps that have to be added to what the photons say.
void list_for_light(uint pixel, Seen seen) {
    for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
        if (needs_rays(seen, pair)) list_pixel(pixel, pair);
}

/// Photons or rays at the end of a path.
void gather_followed(uint pixel) {
    Followed at = followed[pixel];
    if (at.triangle == no_triangle) return;
    Seen seen = see_followed(at);
    Gathered light = no_light();
    Following following = unpack_following(frame.following);
    LampPoints points = points_at_end(hash_uint(pixel + hash_uint(frame.sample_index)), following);
    if (stage == stage_rays) {
        add_rays(seen, frame.ray_pair, points, light);
    } else {
        light = estimate_at(seen);
        list_for_light(pixel, seen);
    }
    float lux = (at.flags & followed_gives_illuminance) != 0u ? luminance(light.irradiance) : 0.0f;
    radiance_illuminance[pixel] +=
        vec4(at.weight * light.radiance, lux) * (frame.sample_weight / float(following.paths));
}

/// Photons or rays at what a pixel sees; lists the pixels from which paths go on.
Gathered gather_seen(uint pixel, Seen seen) {
    Gathered light = no_light();
    if (stage == stage_rays) {
        LampPoints points = first_points(hash_uint(pixel));
        points.round = frame.sample_index;
        add_rays(seen, frame.ray_pair, points, light);
    } else {
        light = estimate_at(seen);
        light.radiance += own_radiance(seen.surface, seen.front);
        list_for_light(pixel, seen);
        for (uint branch = 0u; has_followed && branch < branch_count; ++branch)
            if (goes_on(seen, branch)) list_pixel(pixel, ray_pairs(light_count) + branch);
    }
    light.radiance *= shown_part(seen);
    if (is_followed_through(seen)) light.irradiance = vec3(0.0f);
    return light;
}

void main() {
    uint pixel = pixel_to_shade();
    if (pixel >= frame.width * frame.height) return;
    if (has_followed && stage == stage_follow) {
        follow_pixel(pixel);
        return;
    }
    if (has_followed && of_followed) {
        gather_followed(pixel);
        return;
    }
    uvec4 visible = texelFetch(visibility, ivec2(pixel % frame.width, pixel / frame.width), 0);
    Gathered light = no_light();
    if (visible.x < frame.triangle_limit) {
        Seen seen = seen_by(pixel);
        if (gather_mode == gather_mode_inspect) {
            radiance_illuminance[pixel] = inspect_pixel(seen, hash_uint(pixel + hash_uint(frame.sample_index)));
            return;
        }
        light = gather_seen(pixel, seen);
    }
    vec4 sum = vec4(light.radiance, luminance(light.irradiance)) * frame.sample_weight;
    if (stage == stage_rays || frame.sample_index > 0u) sum += radiance_illuminance[pixel];
    radiance_illuminance[pixel] = sum;
}
