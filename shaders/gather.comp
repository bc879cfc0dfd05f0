// Light at what each pixel sees: the photons of the map on the visible side of the triangle, through the BRDF, direct light
// by shadow rays, and the surface's own glow. Writes radiance (cd/m2) and illuminance (lux), shading normal and depth (m along -Z).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { Frame frame; };

LW_ARRAY(Lamp, lamps);
LW_ARRAY(uint, triangle_maps);
LW_ARRAY(SurfaceGrid, grids);
LW_ARRAY(uint, cell_starts);
LW_ARRAY(BvhNode, bvh_nodes);
LW_ARRAY(uint, bvh_triangles);
LW_ARRAY(Emitter, emitters);
LW_ARRAY(LatticeNode, nodes);
LW_ARRAY(uint, visible_lamps);
layout(set = 0, binding = binding_places, scalar) readonly buffer Places { PhotonPlace records[]; }
places[most_place_chunks];
layout(set = 0, binding = binding_fluxes, scalar) readonly buffer Fluxes { uint records[]; }
fluxes[most_flux_chunks];
layout(set = 0, binding = binding_directions, scalar) readonly buffer Directions { uint records[]; }
directions[most_flux_chunks];

layout(set = 1, binding = binding_visibility) uniform utexture2D visibility;
layout(set = 1, binding = binding_radiance, scalar) buffer Radiance { vec4 radiance_illuminance[]; };
layout(set = 1, binding = binding_normal_depth, scalar) writeonly buffer NormalDepth { vec4 normal_depth[]; };

#define max_radius frame.max_radius
#define neighbours frame.neighbours
#define inverse_flux_scale frame.inverse_flux_scale
#define ray_epsilon frame.ray_epsilon
#define scene_size frame.scene_size
#define shadow_rays frame.shadow_rays
#define inverse_irradiance_scale frame.inverse_irradiance_scale
#define light_count uint(lamps.length())
#define bvh_node_count uint(bvh_nodes.length())

// Constant indices only: the arrays of buffers need no dynamic indexing, and one chunk costs no branch.
PhotonPlace photon_place(uint i) {
    uint chunk = place_chunks == 1u ? 0u : i >> place_shift;
    if (place_chunks > 1u) i &= (1u << place_shift) - 1u;
    if (place_chunks > 1u && chunk == 1u) return places[1].records[i];
    if (place_chunks > 2u && chunk == 2u) return places[2].records[i];
    if (place_chunks > 3u && chunk == 3u) return places[3].records[i];
    return places[0].records[i];
}

uint photon_flux(uint i) {
    uint chunk = flux_chunks == 1u ? 0u : i >> flux_shift;
    if (flux_chunks > 1u) i &= (1u << flux_shift) - 1u;
    if (flux_chunks > 1u && chunk == 1u) return fluxes[1].records[i];
    return fluxes[0].records[i];
}

uint photon_direction(uint i) {
    uint chunk = flux_chunks == 1u ? 0u : i >> flux_shift;
    if (flux_chunks > 1u) i &= (1u << flux_shift) - 1u;
    if (flux_chunks > 1u && chunk == 1u) return directions[1].records[i];
    return directions[0].records[i];
}

vec3 light_weight(uint light) { return lamps[light].weight; }

uint node_coverage(uint node) { return nodes[node].coverage; }

uint node_irradiance(uint node) { return nodes[node].irradiance; }

vec3 lamp_factor(uint light) { return lamps[light].factor; }

Light light_at(uint i) { return lamps[i].light; }

#include "surface.glsl"
#include "bsdf.glsl"
#include "gather.glsl"
#include "rays.glsl"
#include "direct.glsl"
#include "shade.glsl"
#include "inspect.glsl"

void store(uint pixel, vec4 light, vec4 geometry) {
    vec4 before = frame.sample_index == 0u ? vec4(0.0f) : radiance_illuminance[pixel];
    radiance_illuminance[pixel] = before + light * frame.sample_weight;
    if (frame.sample_index == 0u) normal_depth[pixel] = geometry;
}

/// What the estimate of a pixel stands on; the photons' dots are two pixels wide.
vec4 inspect_pixel(uint triangle, vec2 barycentrics, uint seed) {
    Surface s = surface_at(triangle, barycentrics);
    vec3 to_eye = frame.camera_position - s.position;
    float pixel_metres = length(to_eye) * 2.0f / (frame.projection.y * float(frame.height));
    bool front = dot(s.geometric_normal, to_eye) >= 0.0f;
    vec3 n = front ? s.geometric_normal : -s.geometric_normal;
    uint map = triangle_maps[2u * triangle + (front ? 0u : 1u)];
    Inspected i = inspect(map, s, n, normalize(to_eye), pixel_metres, seed);
    return vec4(i.bandwidth, i.photons, i.relative_error, i.dot_lamp);
}

void main() {
    uvec2 xy = gl_GlobalInvocationID.xy;
    if (xy.x >= frame.width || xy.y >= frame.height) return;
    uint pixel = xy.y * frame.width + xy.x;
    uvec4 visible = texelFetch(visibility, ivec2(xy), 0);
    if (visible.x >= frame.triangle_limit) {
        store(pixel, vec4(0.0f), vec4(0.0f));
        return;
    }
    uint seed = hash_uint(pixel + hash_uint(frame.sample_index));
    if (gather_mode == gather_mode_inspect) {
        store(pixel, inspect_pixel(visible.x, uintBitsToFloat(visible.yz), seed), vec4(0.0f));
        return;
    }
    Shaded seen = shade(visible.x, uintBitsToFloat(visible.yz), frame.camera_position, seed);
    float illuminance = dot(seen.light.irradiance, vec3(0.2126f, 0.7152f, 0.0722f));
    store(pixel, vec4(seen.light.radiance, illuminance),
          vec4(seen.normal, dot(frame.camera_position - seen.position, frame.camera_back)));
}
