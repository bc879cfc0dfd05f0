// Direct light of the lamps at a surface, by shadow rays through the BVH. A delta light takes one ray, a mesh takes
// `shadow_rays`. No ray is traced where the lattice cell knows that a lamp lights all or nothing of it, or has a shadow
// mask of the lamp. With has_shadow_rays false no ray is traced at all, and shadows are as sharp as the masks and the
// lattice. `cell` and `f` are those of a GridPlace: a lattice cell, and the place in it, 0 to 1 along u and v. One text
// for C++ and GLSL. The including scope provides what gather.glsl, rays.glsl and lights.glsl need, the functions
// light_at, lamp_power, lattice_row_entry, shadow_mask, and the constants has_area_lamps, has_visible_lamps,
// has_shadow_masks, has_smooth_caustics, has_shadow_rays, has_followed, light_count, shadow_rays, lobe_paths (per pixel
// along a lobe) and ray_epsilon.

/// A hash of 32 bits whose results look random even for successive numbers (Wellons 2018, "lowbias32").
uint hash_uint(uint x) LW_MEMBER {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// What is known of the light of one lamp at a place.
struct LampVisibility {
    vec3 passed;      // the part of the light that arrives, when by_rays is false
    bool by_rays;     // only shadow rays can tell what arrives
    bool in_lattice;  // the cached light of the lattice cell holds this lamp's, all but what a specular lobe reflects
};

/// Two points of a shadow mask, side by side: bit 0 of the result is point (x, y), bit 1 is (x + 1, y); set when lit.
/// `x`: 0 to 6, `y`: 0 to 7. `mask`: as in LatticeLight::masks().
uint mask_points(uvec4 mask, uint x, uint y) LW_MEMBER {
    uint half_mask = y < shadow_mask_rows ? mask.x : mask.y;
    return (half_mask >> (shadow_mask_side * (y % shadow_mask_rows) + x)) & 3u;
}

/// How much of the lamp's light reaches the place `f` of the cell by its shadow mask: 0 (dark) to 1 (lit), interpolated
/// between the four nearest points.
float lit_part(uvec4 mask, vec2 f) LW_MEMBER {
    float last = float(shadow_mask_side - 1u);
    vec2 at = clamp(f * float(shadow_mask_side) - 0.5f, vec2(0.0f), vec2(last));
    vec2 base = min(floor(at), vec2(last - 1.0f));
    uint x = uint(base.x);
    uint y = uint(base.y);
    return corners_set(mask_points(mask, x, y) | mask_points(mask, x, y + 1u) << 2, at - base);
}

/// True when of the 4 x 4 points of a shadow mask around the place `f` of the cell some are lit and some are dark: then
/// the border of a shadow is near, and the mask is too coarse.
bool is_edge(uvec4 mask, vec2 f) LW_MEMBER {
    int last_point = int(shadow_mask_side) - 1;
    int x = int(floor(f.x * float(shadow_mask_side) - 0.5f));
    int y = int(floor(f.y * float(shadow_mask_side) - 0.5f));
    ivec2 first = ivec2(clamp(x - 1, 0, last_point), clamp(y - 1, 0, last_point));
    ivec2 last = ivec2(clamp(x + 2, 0, last_point), clamp(y + 2, 0, last_point));
    uint columns = ((2u << uint(last.x)) - (1u << uint(first.x))) * shadow_mask_column;
    uint low = columns & shadow_mask_row_bits(first.y, last.y);
    uint high = columns & shadow_mask_row_bits(first.y - int(shadow_mask_rows), last.y - int(shadow_mask_rows));
    bool dark = (mask.x & low) == 0u && (mask.y & high) == 0u;
    bool lit = (mask.x & low) == low && (mask.y & high) == high;
    return !dark && !lit;
}

/// The weight, 0 to 1, of a light sample whose place on the lamp a ray along the specular lobe may meet too, by the
/// power heuristic (Veach 1997). The ray's light has the rest of the weight. `to_view`: unit, as everywhere here.
float share_of_sample(Surface s, vec3 n_shading, vec3 to_view, LightSample light) LW_MEMBER {
    float by_samples = float(max(shadow_rays, 1u)) * light.pdf;
    float by_ray = float(lobe_paths) * lobe_pdf(s, n_shading, to_view, light.to_light);
    return by_samples * by_samples / max(by_samples * by_samples + by_ray * by_ray, 1e-30f);
}

/// Light of a lamp without a surface that comes from behind through a rough sheet or volume. `incoming`: its irradiance
/// on a plane that faces it, lx per RGB. Returns radiance towards the viewer, cd/m2, after one shadow ray.
vec3 transmitted_light(Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LightSample light,
                       vec3 incoming) LW_MEMBER {
    vec3 f = eval_btdf(s, n_shading, to_view, light.to_light) * max(-dot(n_shading, light.to_light), 0.0f);
    if (has_shadow_rays && max(f.x, max(f.y, f.z)) > 0.0f)
        f *= shadow_ray(s.position - n_geometric * ray_epsilon, light.to_light, light.far - 2.0f * ray_epsilon);
    return incoming * f;
}

/// True where a surface spreads the light of lamps behind it towards the viewer. add_lamp() adds it for lamps without a
/// surface; followed rays bring that of mesh lamps.
bool shows_lights_behind(Surface s) LW_MEMBER {
    return has_followed && has_transmission && s.transmission > 0.0f && !transmits_smoothly(s);
}

/// What is known of a lamp at a place before any ray is traced. `bits`: the eight bits of the lamp in the lattice cell,
/// as lattice_lamp_bits() returns them. `mask`: the index of its shadow mask, read only where the bits have
/// has_shadow_mask. `f`: the place in the cell.
LampVisibility lamp_visibility(uint bits, uint mask, vec2 f, Surface s) LW_MEMBER {
    LampVisibility visible;
    visible.in_lattice = gather_mode == gather_mode_cached && (bits & in_lattice_light) != 0u;
    visible.passed = vec3(1.0f);
    bool behind = shows_lights_behind(s);
    visible.by_rays = has_shadow_rays && (behind || (bits & (some_visible | some_hidden)) != some_visible);
    if (!has_shadow_rays && has_visible_lamps)
        visible.passed = vec3(corners_set(seeing_corners(bits), f));  // 0 where the place lies in no grid
    if (has_shadow_masks && !behind && (bits & has_shadow_mask) != 0u) {
        uvec4 points = shadow_mask(mask);
        visible.by_rays = has_shadow_rays && is_edge(points, f);
        if (!visible.by_rays) visible.passed = lit_part(points, f) * unpack_rgb9e5(points.z);
    }
    return visible;
}

/// Which places of mesh lamps are sampled: elements of the R2 sequence (Roberts 2018), shifted by a hash of `seed`
/// (Cranley & Patterson 1976). A pixel that adds direct light several times counts the rounds from 0; each takes the
/// elements that follow those of the round before.
struct LampPoints {
    uint seed;
    uint round;
};

/// Round 0 of a seed.
LampPoints first_points(uint seed) LW_MEMBER {
    LampPoints points;
    points.seed = seed;
    points.round = 0u;
    return points;
}

/// Element `element` of the sequence for a lamp, in [0, 1) x [0, 1). The fractions are integers over 2^32, so that late
/// elements are as exact as early ones.
vec2 lamp_point(LampPoints points, uint lamp, uint element) LW_MEMBER {
    uint shift = hash_uint(points.seed + hash_uint(lamp));
    uint x = (shift << 16) + element * 3242174889u;
    uint y = (shift & 0xffff0000u) + element * 2447445414u;
    return vec2(float(x >> 8), float(y >> 8)) / 16777216.0f;
}

/// Adds to `sum` the light of lamp `i` that arrives at a surface (irradiance, lx) and that the surface reflects or
/// transmits to the viewer (radiance, cd/m2). Traces a shadow ray a sample where `visible` asks for rays.
void add_lamp(uint i, LampVisibility visible, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
              LampPoints points, LW_INOUT(Gathered) sum) LW_MEMBER {
    Light lamp = light_at(i);
    bool delta = !has_area_lamps || is_delta(lamp.type);
    bool beside_rays =
        leaves_lobe_out(s) && has_surface(lamp.type);  // followed rays bring the rest of the lobe's light
    vec3 weight = lamp_power(i) * visible.passed;
    uint samples = delta ? 1u : max(shadow_rays, 1u);
    for (uint j = 0u; j < samples; ++j) {
        vec2 u = delta ? vec2(0.0f) : lamp_point(points, i, points.round * samples + j);
        LightSample light = sample_light(lamp, s.position, u);
        float cos_geometric = dot(n_geometric, light.to_light);
        vec3 incoming = weight * light.irradiance / float(samples);
        if (shows_lights_behind(s) && !has_surface(lamp.type) && cos_geometric < 0.0f)
            sum.radiance += transmitted_light(s, n_geometric, n_shading, to_view, light, incoming);
        if (cos_geometric <= 0.0f || max(incoming.x, max(incoming.y, incoming.z)) <= 0.0f) continue;
        if (has_shadow_rays && visible.by_rays)
            incoming *=
                shadow_ray(s.position + n_geometric * ray_epsilon, light.to_light, light.far - 2.0f * ray_epsilon);
        BrdfParts f = brdf_parts(s, n_shading, to_view, light.to_light);
        if (beside_rays) f.specular *= share_of_sample(s, n_shading, to_view, light);
        if (visible.in_lattice) f.diffuse = vec3(0.0f);
        if (!visible.in_lattice) sum.irradiance += incoming * cos_geometric;
        sum.radiance += incoming * max(dot(n_shading, light.to_light), 0.0f) * (f.diffuse + f.specular);
    }
}

/// What the lattice cell of a place knows of the lamps of a column, as lattice_lamp_column() counts them; 0 when it
/// knows nothing.
uint lamp_bits(GridPlace at, uint column) LW_MEMBER {
    bool has_marks = has_smooth_caustics || has_shadow_masks;
    if (!has_visible_lamps || at.index == no_grid) return 0u;
    return lattice_row_entry(at.cell * lattice_row_length(light_count, has_marks) + (has_marks ? 1u : 0u) + column);
}

/// True for a specular lobe that rays follow but that is no mirror. What it reflects of mesh lamps is sampled in two
/// ways: by rays along the lobe, and by places on the lamps.
bool samples_lobe(Surface s) LW_MEMBER { return leaves_lobe_out(s) && s.roughness * s.roughness >= min_alpha; }

/// The lamps of a pair whose direct light a pixel has to add, as lamps_with() gives them. Lamps that are hidden from
/// all of the cell are skipped; in the cached mode so are those that the light of the cell holds, unless a specular
/// lobe is to reflect them. `bits`: the column of the pair, from lamp_bits().
uint lamps_to_add(uint bits, uint pair, Surface s) LW_MEMBER {
    uint skipped = lamps_with(bits, some_hidden) & ~lamps_with(bits, some_visible);
    if (shows_lights_behind(s)) skipped = 0u;
    if (gather_mode == gather_mode_cached && !samples_lobe(s)) skipped |= lamps_with(bits, in_lattice_light);
    uint first = pair * lamps_per_pair;
    uint lamps = min(light_count - min(first, light_count), lamps_per_pair);
    uint all = ((1u << (bits_per_lattice_lamp * lamps)) - 1u) << lattice_lamp_shift(first);
    return lowest_lamp_bits & ~skipped & all;
}

/// The index of the shadow mask of the first lamp of a column that has one.
uint first_shadow_mask(GridPlace at, uint column) LW_MEMBER {
    if (!has_shadow_masks || !has_visible_lamps || at.index == no_grid) return 0u;
    uint mask = lattice_row_entry(at.cell * lattice_row_length(light_count, true)) >> first_mask_shift;
    for (uint before = 0u; before < column; ++before)
        mask += bitCount(lamps_with(lamp_bits(at, before), has_shadow_mask));
    return mask;
}

/// What is known of the lamp whose bits begin at `shift` in its column. `bits`: the column; `first_mask`: from
/// first_shadow_mask().
LampVisibility lamp_visibility_in_column(GridPlace at, uint bits, uint shift, uint first_mask, Surface s) LW_MEMBER {
    uint masks_before = uint(bitCount(lamps_with(bits & ((1u << shift) - 1u), has_shadow_mask)));
    return lamp_visibility(lattice_lamp_bits(bits, shift), first_mask + masks_before, at.f, s);
}

/// Adds to `sum` the direct light of one pair of lamps at a place. `pair`: 0 to ray_pairs() - 1.
void add_direct(GridPlace at, uint pair, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LampPoints points,
                LW_INOUT(Gathered) sum) LW_MEMBER {
    uint column = lattice_lamp_column(pair * lamps_per_pair);
    uint bits = lamp_bits(at, column);
    uint first_mask = first_shadow_mask(at, column);
    for (uint todo = lamps_to_add(bits, pair, s); todo != 0u; todo &= todo - 1u) {
        uint shift = uint(findLSB(todo));
        LampVisibility visible = lamp_visibility_in_column(at, bits, shift, first_mask, s);
        add_lamp(column * lamps_per_lattice_column + shift / bits_per_lattice_lamp, visible, s, n_geometric, n_shading,
                 to_view, points, sum);
    }
}
