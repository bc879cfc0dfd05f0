// What a view ray brings back from the surface it meets, mirrors followed. One text for C++ and GLSL; needs gather.glsl,
// caustics.glsl, rays.glsl, direct.glsl, the functions map_of, lamp_factor and the constants has_caustics, has_direct,
// has_mirrors.

/// A surface as the eye sees it.
struct Seen {
    uint triangle;
    Surface surface;
    MapPlace at;
    vec3 to_eye;
    vec3 n_geometric;  // both turned to the eye
    vec3 n_shading;
    bool front;
};

Seen see(uint triangle, vec2 barycentrics, vec3 eye) LW_MEMBER {
    Seen seen;
    seen.triangle = triangle;
    seen.surface = surface_at(triangle, barycentrics);
    seen.to_eye = normalize(eye - seen.surface.position);
    seen.front = dot(seen.surface.geometric_normal, seen.to_eye) >= 0.0f;
    seen.n_geometric = seen.front ? seen.surface.geometric_normal : -seen.surface.geometric_normal;
    seen.n_shading = seen.front ? seen.surface.normal : -seen.surface.normal;
    seen.at = place_on(map_of(triangle, seen.front), seen.surface.position);
    return seen;
}

/// What a surface shows by itself: its glow, or its colour when unlit.
vec3 own_radiance(Surface s, bool front) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return s.base_color;
    if (!front && (s.flags & material_double_sided) == 0u) return vec3(0.0f);
    return s.emissive * (s.light >= 0 ? lamp_factor(uint(s.light)) : vec3(1.0f));
}

/// Photons, glow and the lamps that the cell knows: all there is to see, but for add_rays() where needs_rays() says so.
Gathered without_rays(Seen seen, uint seed) LW_MEMBER {
    Gathered light = gather_photons(seen.at, seen.surface, seen.n_geometric, seen.n_shading, seen.to_eye);
    float left = has_caustics ? caustics_left(seen.at) : 0.0f;
    if (has_caustics && left > 0.0f)
        add_caustics(seen.triangle, seen.front, left, seen.at, seen.surface, seen.n_geometric, seen.n_shading, seen.to_eye,
                     light);
    for (uint word = 0u; has_direct && word < cell_lamp_words(light_count); ++word)
        add_direct(seen.at, word, false, seen.surface, seen.n_geometric, seen.n_shading, seen.to_eye, seed, light);
    light.radiance += own_radiance(seen.surface, seen.front);
    return light;
}

/// True when shadow rays have to be traced to lamps of a word, or a mirror to be followed.
bool needs_rays(Seen seen, uint word) LW_MEMBER {
    return (has_mirrors && is_purely_specular(seen.surface)) || (has_direct && needs_shadow_rays(seen.at, word));
}

/// Adds the lamps of one word, and with the first word what is seen in mirrors beside the lamps' light.
void add_rays(Seen seen, uint word, uint seed, LW_INOUT(Gathered) light) LW_MEMBER {
    vec3 reflected = vec3(1.0f);
    for (uint mirrors = 0u; mirrors <= (has_mirrors ? most_mirrors : 0u); ++mirrors) {
        Surface s = seen.surface;
        Gathered shown = no_light();
        if (mirrors > 0u && word == 0u) shown = without_rays(seen, seed);
        if (has_direct && has_shadow_rays)
            add_direct(seen.at, word, true, s, seen.n_geometric, seen.n_shading, seen.to_eye, seed, shown);
        light.radiance += reflected * shown.radiance;
        if (mirrors == 0u) light.irradiance += shown.irradiance;
        if (!has_mirrors || !is_purely_specular(s)) return;
        vec3 direction = reflect(-seen.to_eye, seen.n_shading);
        if (dot(direction, seen.n_geometric) <= 0.0f) return;
        reflected *= s.base_color + (vec3(1.0f) - s.base_color) * schlick_weight(dot(seen.n_shading, seen.to_eye));
        vec2 barycentrics = vec2(0.0f);
        uint triangle = nearest_surface(s.position + seen.n_geometric * ray_epsilon, direction, scene_size, barycentrics);
        if (triangle == no_map) return;
        seen = see(triangle, barycentrics, s.position);
    }
}

/// All light towards `eye` from (triangle, barycentrics); illuminance, bandwidth and photons are of that place.
Gathered shade(uint triangle, vec2 barycentrics, vec3 eye, uint seed) LW_MEMBER {
    Seen seen = see(triangle, barycentrics, eye);
    Gathered light = without_rays(seen, seed);
    for (uint word = 0u; word < ray_words(light_count); ++word) add_rays(seen, word, seed, light);
    return light;
}
