// Exact direct light by shadow rays through the BVH: one ray for a point, spot or directional lamp, `shadow_rays` for an
// emissive mesh. One text for C++ and GLSL. The including scope provides what surface.glsl and bsdf.glsl need, and the
// arrays bvh_nodes, bvh_triangles, emitters, grids, visible_lamps, the functions light_at and light_weight and the constants has_alpha,
// has_transmission, light_count, shadow_rays, ray_epsilon, scene_size, has_visible_lamps; needs gather.glsl.

/// True when a triangle is crossed by origin + t direction, 0 < t < far (Moeller & Trumbore 1997, edges included).
bool crosses_triangle(uint triangle, vec3 origin, vec3 direction, float far, LW_INOUT(vec2) barycentrics) LW_MEMBER {
    uvec3 corner = triangles[triangle];
    vec3 a = positions[corner.x];
    vec3 ab = positions[corner.y] - a;
    vec3 ac = positions[corner.z] - a;
    vec3 p = cross(direction, ac);
    float determinant = dot(ab, p);
    if (determinant == 0.0f) return false;
    float inverse = 1.0f / determinant;
    vec3 to_origin = origin - a;
    float u = dot(to_origin, p) * inverse;
    vec3 q = cross(to_origin, ab);
    float v = dot(direction, q) * inverse;
    float t = dot(ac, q) * inverse;
    barycentrics = vec2(u, v);
    return u >= -1e-6f && v >= -1e-6f && u + v <= 1.000001f && t > 0.0f && t < far;
}

/// Fraction of light that a crossed triangle lets pass straight through.
vec3 passed_by(uint triangle, vec2 barycentrics, vec3 direction) LW_MEMBER {
    uint flags = materials[objects[triangle_objects[triangle]].material].flags;
    if ((flags & (material_alpha_mask | material_alpha_blend | material_thin)) == 0u) return vec3(0.0f);
    Surface s = surface_at(triangle, barycentrics);
    float cutoff = materials[objects[triangle_objects[triangle]].material].alpha_cutoff;
    if ((flags & material_alpha_mask) != 0u && s.alpha < cutoff) return vec3(1.0f);
    vec3 passed = vec3(0.0f);
    if ((flags & material_thin) != 0u) passed = thin_transmittance(s, abs(dot(s.normal, direction)));
    if ((flags & material_alpha_blend) != 0u) passed = mix(vec3(1.0f), passed, clamp(s.alpha, 0.0f, 1.0f));
    return passed;
}

/// Fraction of light per RGB that reaches `origin` from distance `far` along unit `direction`.
vec3 shadow_ray(vec3 origin, vec3 direction, float far) LW_MEMBER {
    vec3 tiny = vec3(1e-20f);
    vec3 inverse = 1.0f / vec3(abs(direction.x) > tiny.x ? direction.x : tiny.x, abs(direction.y) > tiny.y ? direction.y : tiny.y,
                               abs(direction.z) > tiny.z ? direction.z : tiny.z);
    vec3 light = vec3(1.0f);
    uint node = 0u;
    while (node < bvh_node_count) {
        BvhNode n = bvh_nodes[node];
        vec3 t0 = (n.low - origin) * inverse;
        vec3 t1 = (n.high - origin) * inverse;
        vec3 near3 = min(t0, t1);
        vec3 far3 = max(t0, t1) * 1.000001f;  // Ize 2013: keeps edges of boxes watertight
        float enter = max(max(near3.x, near3.y), max(near3.z, 0.0f));
        float leave = min(min(far3.x, far3.y), min(far3.z, far));
        if (enter > leave) {
            node = n.skip;
            continue;
        }
        for (uint i = n.leaf >> 4; i < (n.leaf >> 4) + (n.leaf & 15u); ++i) {
            vec2 barycentrics = vec2(0.0f);
            if (!crosses_triangle(bvh_triangles[i], origin, direction, far, barycentrics)) continue;
            if (!has_alpha && !has_transmission) return vec3(0.0f);
            light *= passed_by(bvh_triangles[i], barycentrics, direction);
            if (max(light.x, max(light.y, light.z)) <= 0.0f) return vec3(0.0f);
        }
        node = n.leaf == 0u ? node + 1u : n.skip;
    }
    return light;
}

/// Adds light arriving along unit `to_light` with irradiance `incoming` on a plane facing it, as far as no surface
/// within `far` metres is in the way; far = 0: none is, no ray is traced.
void add_incident(vec3 incoming, vec3 to_light, float far, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
                  LW_INOUT(Gathered) sum) LW_MEMBER {
    float cos_geometric = dot(n_geometric, to_light);
    if (cos_geometric <= 0.0f || max(incoming.x, max(incoming.y, incoming.z)) <= 0.0f) return;
    if (far > 0.0f) incoming *= shadow_ray(s.position + n_geometric * ray_epsilon, to_light, far - 2.0f * ray_epsilon);
    if (max(incoming.x, max(incoming.y, incoming.z)) <= 0.0f) return;
    sum.irradiance += incoming * cos_geometric;
    sum.radiance += incoming * max(dot(n_shading, to_light), 0.0f) * eval_brdf(s, n_shading, to_view, to_light, false);
}

/// Point, spot or directional lamp; falloff as KHR_lights_punctual.
void add_punctual(Light lamp, vec3 weight, bool open, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
                  LW_INOUT(Gathered) sum) LW_MEMBER {
    if (lamp.type == light_directional) {
        add_incident(weight, -lamp.direction, open ? 0.0f : scene_size, s, n_geometric, n_shading, to_view, sum);
        return;
    }
    vec3 path = lamp.position - s.position;
    float d2 = dot(path, path);
    if (d2 <= 0.0f) return;
    float far = sqrt(d2);
    vec3 to_light = path / far;
    weight /= d2;
    if (lamp.type == light_spot) {
        float width = max(lamp.cos_inner - lamp.cos_outer, 1e-6f);
        float t = clamp((-dot(to_light, lamp.direction) - lamp.cos_outer) / width, 0.0f, 1.0f);
        weight *= t * t;
    }
    add_incident(weight, to_light, open ? 0.0f : far, s, n_geometric, n_shading, to_view, sum);
}

/// The triangle of a mesh lamp in which a share `u` of its area ends, and how far into it.
uint pick_emitter(Light lamp, float u, LW_INOUT(float) within) LW_MEMBER {
    uint first = lamp.first_emitter;
    uint last = first + lamp.emitter_count - 1u;
    float wanted = u * emitters[last].area_below;
    uint low = first;
    uint high = last;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (wanted < emitters[middle].area_below)
            high = middle;
        else
            low = middle + 1u;
    }
    float start = low == first ? 0.0f : emitters[low - 1u].area_below;
    within = clamp((wanted - start) / max(emitters[low].area_below - start, 1e-30f), 0.0f, 0.99999994f);
    return emitters[low].triangle;
}

/// One point of a mesh lamp, uniform by area, standing for a `share` of it: E = L A cos(theta) cos(theta') / d^2.
void add_mesh_point(Light lamp, vec3 weight, vec2 u, float share, bool open, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
                    LW_INOUT(Gathered) sum) LW_MEMBER {
    float within = 0.0f;
    uint triangle = pick_emitter(lamp, u.x, within);
    float root = sqrt(within);
    Surface e = surface_at(triangle, vec2(root * (1.0f - u.y), root * u.y));
    vec3 path = e.position - s.position;
    float d2 = dot(path, path);
    if (d2 <= 0.0f) return;
    float far = sqrt(d2);
    vec3 to_light = path / far;
    float cos_emitted = -dot(e.geometric_normal, to_light);
    if ((e.flags & material_double_sided) != 0u) cos_emitted = abs(cos_emitted);
    if (cos_emitted <= 0.0f) return;
    float area = emitters[lamp.first_emitter + lamp.emitter_count - 1u].area_below;
    vec3 emitted = e.emissive / max(lamp.intensity, vec3(1e-20f));
    add_incident(weight * emitted * (share * area * cos_emitted / d2), to_light, open ? 0.0f : far, s, n_geometric, n_shading, to_view, sum);
}

uint hash_uint(uint x) LW_MEMBER {  // Wellons 2018, "lowbias32"
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// What is known of lamps 16 `group` to 16 `group` + 15 around a point of a map, two bits each.
uint visibility_around(uint map, vec3 position, uint group) LW_MEMBER {
    if (!has_visible_lamps || map == no_map) return 0u;
    SurfaceGrid grid = grids[map];
    vec2 f = vec2(0.0f);
    uint words = visibility_words(light_count);
    uint node = cell_node(grid.lattice, position_in_grid(grid, position), f) * words + group;
    uint row = grid.lattice.columns * words;
    return visible_lamps[node] | visible_lamps[node + words] | visible_lamps[node + row] | visible_lamps[node + row + words];
}

/// Adds the direct light of all lamps at a point of `map` to what the photons say. `seed` shifts the points on mesh
/// lamps (Cranley & Patterson 1976) of the R2 sequence (Roberts 2018).
void add_direct(uint map, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, uint seed, LW_INOUT(Gathered) sum) LW_MEMBER {
    uint around = 0u;
    for (uint i = 0u; i < light_count; ++i) {
        if (visibility_shift(i) == 0u) around = visibility_around(map, s.position, visibility_word(i));
        uint seen = (around >> visibility_shift(i)) & (some_visible | some_hidden);
        if (seen == some_hidden) continue;
        bool open = seen == some_visible;
        Light lamp = light_at(i);
        vec3 weight = light_weight(i);
        if (max(weight.x, max(weight.y, weight.z)) <= 0.0f) continue;
        if (lamp.type != light_mesh) {
            add_punctual(lamp, weight, open, s, n_geometric, n_shading, to_view, sum);
            continue;
        }
        uint random = hash_uint(seed + hash_uint(i));
        vec2 shift = vec2(float(random & 0xffffu), float(random >> 16)) / 65536.0f;
        for (uint j = 0u; j < shadow_rays; ++j) {
            vec2 u = fract(shift + float(j) * vec2(0.754877666f, 0.569840291f));
            add_mesh_point(lamp, weight, u, 1.0f / float(shadow_rays), open, s, n_geometric, n_shading, to_view, sum);
        }
    }
}
