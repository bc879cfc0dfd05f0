// What a surface shows to an eye, and how photons and lamps add up to it. One text for C++ and GLSL; needs gather.glsl,
// caustics.glsl, rays.glsl, direct.glsl, the functions grid_of, lamp_factor and the constants has_caustics, has_direct.

/// A surface as the eye sees it.
struct Seen {
    uint triangle;
    Surface surface;
    GridPlace at;
    vec3 to_eye;
    vec3 n_geometric;  // both on the side of the eye
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
    if (dot(seen.n_shading, seen.to_eye) <= 1e-4f) seen.n_shading = seen.n_geometric;
    seen.at = place_on_grid(grid_of(triangle, seen.front), seen.surface.position);
    return seen;
}

/// The radiance that a surface emits, or its colour when it is unlit, cd/m2.
vec3 own_radiance(Surface s, bool front) LW_MEMBER {
    if ((s.flags & material_unlit) != 0u) return s.base_color;
    if (!front && (s.flags & material_double_sided) == 0u) return vec3(0.0f);
    return s.emissive * (s.light >= 0 ? lamp_factor(uint(s.light)) : vec3(1.0f));
}

/// The light of a surface from photons and caustics, without its own glow and without what rays add.
Gathered estimate_at(Seen seen) LW_MEMBER {
    Gathered light = gather_photons(seen.at, seen.surface, seen.n_geometric, seen.n_shading, seen.to_eye);
    float left = has_caustics ? caustics_left(seen.at) : 0.0f;
    if (has_caustics && left > 0.0f)
        add_caustics(seen.triangle, seen.front, left, seen.at, seen.surface, seen.n_geometric, seen.n_shading,
                     seen.to_eye, light);
    return light;
}

/// True when a lamp of a pair must be added to the light of the photons.
bool needs_rays(Seen seen, uint pair) LW_MEMBER {
    return has_direct &&
           lamps_to_add(lamp_bits(seen.at, lattice_lamp_column(pair * lamps_per_pair)), pair, seen.surface) != 0u;
}

/// Adds the direct light of one pair of lamps.
void add_rays(Seen seen, uint pair, LampPoints points, LW_INOUT(Gathered) light) LW_MEMBER {
    add_direct(seen.at, pair, seen.surface, seen.n_geometric, seen.n_shading, seen.to_eye, points, light);
}
