// Exact direct light of punctual lamps (point, spot, sun) by shadow rays through the BVH; the light of emissive meshes
// stays in the photons. One text for C++ and GLSL. The including scope provides what surface.glsl and bsdf.glsl need,
// and the arrays bvh_nodes, bvh_triangles, lights, the function light_weight and the constants has_alpha,
// has_transmission, light_count, ray_epsilon.

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

/// Adds the unoccluded, then shadowed, light of one lamp to `sum`.
void add_punctual(uint index, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LW_INOUT(Gathered) sum) LW_MEMBER {
    Light lamp = lights[index];
    vec3 weight = light_weight(index);
    if (lamp.type == light_mesh || max(weight.x, max(weight.y, weight.z)) <= 0.0f) return;
    vec3 to_light = -lamp.direction;
    float far = scene_size;
    if (lamp.type != light_directional) {
        vec3 path = lamp.position - s.position;
        float d2 = dot(path, path);
        if (d2 <= 0.0f) return;
        far = sqrt(d2);
        to_light = path / far;
        weight /= d2;
    }
    if (lamp.type == light_spot) {  // KHR_lights_punctual
        float t = clamp((-dot(to_light, lamp.direction) - lamp.cos_outer) / max(lamp.cos_inner - lamp.cos_outer, 1e-6f), 0.0f, 1.0f);
        weight *= t * t;
        if (t <= 0.0f) return;
    }
    float cos_geometric = dot(n_geometric, to_light);
    if (cos_geometric <= 0.0f) return;
    vec3 origin = s.position + n_geometric * ray_epsilon;
    weight *= shadow_ray(origin, to_light, far - ray_epsilon);
    if (max(weight.x, max(weight.y, weight.z)) <= 0.0f) return;
    sum.irradiance += weight * cos_geometric;
    sum.radiance += weight * max(dot(n_shading, to_light), 0.0f) * eval_brdf(s, n_shading, to_view, to_light, false);
}

/// Adds the direct light of all punctual lamps to what the photons say.
void add_direct(Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LW_INOUT(Gathered) sum) LW_MEMBER {
    for (uint i = 0u; i < light_count; ++i) add_punctual(i, s, n_geometric, n_shading, to_view, sum);
}
