// What a view ray brings back from the surface it meets, mirrors followed. One text for C++ and GLSL; needs gather.glsl,
// rays.glsl, direct.glsl, the array triangle_maps, the function lamp_factor and the constants has_direct, has_mirrors.

struct Shaded {
    Gathered light;  // radiance towards the eye; illuminance, bandwidth and photons of the first surface
    vec3 position;   // of the first surface
    vec3 normal;     // its shading normal, turned to the eye
};

/// What a surface shows by itself: its glow, or its colour when unlit.
vec3 own_radiance(Surface s, bool front) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return s.base_color;
    if (!front && (s.flags & material_double_sided) == 0u) return vec3(0.0f);
    return s.emissive * (s.light >= 0 ? lamp_factor(uint(s.light)) : vec3(1.0f));
}

/// The surface at (triangle, barycentrics) seen from `eye`.
Shaded shade(uint triangle, vec2 barycentrics, vec3 eye, uint seed) LW_MEMBER {
    Shaded result;
    vec3 reflected = vec3(1.0f);
    for (uint mirrors = 0u; mirrors <= (has_mirrors ? most_mirrors : 0u); ++mirrors) {
        Surface s = surface_at(triangle, barycentrics);
        vec3 to_eye = normalize(eye - s.position);
        bool front = dot(s.geometric_normal, to_eye) >= 0.0f;
        vec3 n_geometric = front ? s.geometric_normal : -s.geometric_normal;
        vec3 n_shading = front ? s.normal : -s.normal;
        uint map = triangle_maps[2u * triangle + (front ? 0u : 1u)];
        Gathered light = gather_photons(map, s, n_geometric, n_shading, to_eye);
        if (has_direct) add_direct(map, s, n_geometric, n_shading, to_eye, seed, light);
        light.radiance += own_radiance(s, front);
        if (mirrors == 0u) {
            result.light = light;
            result.position = s.position;
            result.normal = n_shading;
        } else {
            result.light.radiance += reflected * light.radiance;
        }
        if (!has_mirrors || !is_purely_specular(s)) break;
        vec3 direction = reflect(-to_eye, n_shading);
        if (dot(direction, n_geometric) <= 0.0f) break;
        reflected *= s.base_color + (vec3(1.0f) - s.base_color) * schlick_weight(dot(n_shading, to_eye));
        triangle = nearest_surface(s.position + n_geometric * ray_epsilon, direction, scene_size, barycentrics);
        if (triangle == no_map) break;
        eye = s.position;
    }
    return result;
}
