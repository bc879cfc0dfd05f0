// Exact direct light by shadow rays through the BVH: one ray for a point, spot or directional lamp, `shadow_rays` for
// an emissive mesh; none where the cell knows what a lamp lights, all over or by a mask; with shadow_rays = 0 none at
// all, and shadows as sharp as masks and lattice. One text for C++ and GLSL. The including scope provides what
// gather.glsl and rays.glsl need, the array emitters, the functions light_at, light_power, profile_value, cell_word,
// shadow_mask, and the constants has_mesh_lamps, has_profiles, has_emissive_textures, has_visible_lamps,
// has_shadow_masks, has_smooth_caustics, has_shadow_rays, has_followed, light_count, shadow_rays, lobe_paths (per pixel
// along a lobe), ray_epsilon, scene_size.

/// Light that would arrive at a point from one place of a lamp at unit intensity, if nothing stood between.
struct LightSample {
    vec3 irradiance;  // on a plane facing the light
    vec3 to_light;    // unit
    float far;        // m
    float pdf;        // solid angle; 0 for points and suns
};

/// Point, spot or directional lamp; falloff as KHR_lights_punctual.
LightSample sample_punctual(Light lamp, vec3 position) LW_MEMBER {
    LightSample result;
    result.irradiance = vec3(1.0f);
    result.to_light = -lamp.direction;
    result.far = scene_size;
    result.pdf = 0.0f;
    if (lamp.type == light_directional) return result;
    vec3 path = lamp.position - position;
    float d2 = max(dot(path, path), 1e-30f);
    result.far = sqrt(d2);
    result.to_light = path / result.far;
    float width = max(lamp.cos_inner - lamp.cos_outer, 1e-6f);
    float t = clamp((-dot(result.to_light, lamp.direction) - lamp.cos_outer) / width, 0.0f, 1.0f);
    result.irradiance = vec3((lamp.type == light_spot ? t * t : 1.0f) / d2);
    if (has_profiles && lamp.type == light_profile) result.irradiance *= profile_value(lamp, -result.to_light);
    return result;
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

/// Solid-angle density with which a point of a mesh lamp is picked that is met from `distance` at `cosine` to its
/// normal.
float point_pdf(Light lamp, float distance, float cosine) LW_MEMBER {
    float area = emitters[lamp.first_emitter + lamp.emitter_count - 1u].area_below;
    return distance * distance / (area * max(abs(cosine), 1e-6f));
}

/// One point of a mesh lamp, uniform by area, standing for all of it: E = L A cos(theta') / d^2.
LightSample sample_mesh(Light lamp, vec3 position, vec2 u) LW_MEMBER {
    float within = 0.0f;
    uint triangle = pick_emitter(lamp, u.x, within);
    float root = sqrt(within);
    vec2 barycentrics = vec2(root * (1.0f - u.y), root * u.y);
    vec3 a = corner_position(triangle, 0u);
    vec3 ab = corner_position(triangle, 1u) - a;
    vec3 ac = corner_position(triangle, 2u) - a;
    vec3 path = a + barycentrics.x * ab + barycentrics.y * ac - position;
    float d2 = max(dot(path, path), 1e-30f);
    LightSample result;
    result.far = sqrt(d2);
    result.to_light = path / result.far;
    vec3 product = cross(ab, ac);
    float cos_emitted = -dot(product, result.to_light) / max(length(product), 1e-30f);
    Material material = material_of(triangle);
    if ((material.flags & material_double_sided) != 0u) cos_emitted = abs(cos_emitted);
    float area = emitters[lamp.first_emitter + lamp.emitter_count - 1u].area_below;
    vec3 emitted = material.emissive;
    if (has_emissive_textures || has_alpha) {
        Surface there = surface_at(triangle, barycentrics);
        emitted = there.emissive * opacity_at(triangle, there);  // holes do not glow
    }
    result.irradiance = emitted / max(lamp.intensity, vec3(1e-20f)) * (area * max(cos_emitted, 0.0f) / d2);
    result.pdf = point_pdf(lamp, result.far, cos_emitted);
    return result;
}

uint hash_uint(uint x) LW_MEMBER {  // Wellons 2018, "lowbias32"
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// What is known of the light of one lamp at a place.
struct LampVisibility {
    vec3 passed;   // the part that arrives, unless
    bool by_rays;  // only rays tell
    bool in_cell;  // the light of the cell holds it: but for a lobe
};

/// The part of 8 x 8 points that are lit, between the four around `f` in the cell.
float lit_part(uvec4 mask, vec2 f) LW_MEMBER {
    float last = float(shadow_mask_side - 1u);
    vec2 at = clamp(f * float(shadow_mask_side) - 0.5f, vec2(0.0f), vec2(last));
    vec2 base = min(floor(at), vec2(last - 1.0f));
    uint x = uint(base.x);
    uint y = uint(base.y);
    uint row = ((y < 4u ? mask.x : mask.y) >> (shadow_mask_side * (y & 3u) + x)) & 3u;
    uint above = (((y + 1u) < 4u ? mask.x : mask.y) >> (shadow_mask_side * ((y + 1u) & 3u) + x)) & 3u;
    return corners_set(row | above << 2, at - base);
}

/// True when the 4 x 4 points around `f` in the cell are not all lit or all dark.
bool is_edge(uvec4 mask, vec2 f) LW_MEMBER {
    ivec2 base =
        ivec2(int(floor(f.x * float(shadow_mask_side) - 0.5f)), int(floor(f.y * float(shadow_mask_side) - 0.5f)));
    ivec2 first = ivec2(clamp(base.x - 1, 0, 7), clamp(base.y - 1, 0, 7));
    ivec2 last = ivec2(clamp(base.x + 2, 0, 7), clamp(base.y + 2, 0, 7));
    uint columns = ((2u << uint(last.x)) - (1u << uint(first.x))) * 0x01010101u;
    uint low_rows = first.y > 3 ? 0u
                                : (0xffffffffu << uint(8 * first.y)) &
                                      (last.y > 2 ? 0xffffffffu : (1u << uint(8 * last.y + 8)) - 1u);
    uint high_rows = last.y < 4 ? 0u
                                : (last.y > 6 ? 0xffffffffu : (1u << uint(8 * last.y - 24)) - 1u) &
                                      (first.y < 5 ? 0xffffffffu : 0xffffffffu << uint(8 * first.y - 32));
    uint low = columns & low_rows;
    uint high = columns & high_rows;
    bool dark = (mask.x & low) == 0u && (mask.y & high) == 0u;
    bool lit = (mask.x & low) == low && (mask.y & high) == high;
    return !dark && !lit;
}

/// What a light sample counts beside a ray along the specular lobe that might meet the same lamp (power heuristic,
/// Veach 1997).
float share_of_sample(Surface s, vec3 n_shading, vec3 to_view, LightSample light) LW_MEMBER {
    float by_samples = float(max(shadow_rays, 1u)) * light.pdf;
    float by_ray = float(lobe_paths) * lobe_pdf(s, n_shading, to_view, light.to_light);
    return by_samples * by_samples / max(by_samples * by_samples + by_ray * by_ray, 1e-30f);
}

/// Light of a point or sun from behind a rough sheet or volume.
vec3 transmitted_light(Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LightSample light,
                       vec3 incoming) LW_MEMBER {
    vec3 f = eval_btdf(s, n_shading, to_view, light.to_light) * max(-dot(n_shading, light.to_light), 0.0f);
    if (has_shadow_rays && max(f.x, max(f.y, f.z)) > 0.0f)
        f *= shadow_ray(s.position - n_geometric * ray_epsilon, light.to_light, light.far - 2.0f * ray_epsilon);
    return incoming * f;
}

/// True where light of points behind a surface spreads to the viewer.
bool shows_points_behind(Surface s) LW_MEMBER {
    return has_followed && has_transmission && s.transmission > 0.0f && !transmits_smoothly(s);
}

/// `bits` are what the cell knows of the lamp, `mask` its shadow mask, if it has one.
LampVisibility lamp_visibility(uint bits, uint mask, vec2 f, Surface s) LW_MEMBER {
    LampVisibility visible;
    visible.in_cell = gather_mode == gather_mode_cached && (bits & in_cell_light) != 0u;
    visible.passed = vec3(1.0f);
    bool behind = shows_points_behind(s);
    visible.by_rays = has_shadow_rays && (behind || (bits & (some_visible | some_hidden)) != some_visible);
    if (!has_shadow_rays && has_visible_lamps)
        visible.passed = vec3(corners_set(seeing_corners(bits), f));  // in no grid: of no lamp
    if (has_shadow_masks && !behind && (bits & has_shadow_mask) != 0u) {
        uvec4 points = shadow_mask(mask);
        visible.by_rays = has_shadow_rays && is_edge(points, f);
        if (!visible.by_rays) visible.passed = lit_part(points, f) * unpack_rgb9e5(points.z);
    }
    return visible;
}

/// Which points of mesh lamps are looked at: elements of the R2 sequence (Roberts 2018), shifted by `seed` (Cranley &
/// Patterson 1976). Another round goes on where the one before it ended.
struct LampPoints {
    uint seed;
    uint round;
};

LampPoints first_points(uint seed) LW_MEMBER {
    LampPoints points;
    points.seed = seed;
    points.round = 0u;
    return points;
}

/// Element `element` of the sequence for a lamp, in [0, 1) x [0, 1); fractions of 2^32, exact however many there are.
vec2 lamp_point(LampPoints points, uint lamp, uint element) LW_MEMBER {
    uint shift = hash_uint(points.seed + hash_uint(lamp));
    uint x = (shift << 16) + element * 3242174889u;
    uint y = (shift & 0xffff0000u) + element * 2447445414u;
    return vec2(float(x >> 8), float(y >> 8)) / 16777216.0f;
}

/// Adds the light of lamp `i`, as much as arrives.
void add_lamp(uint i, LampVisibility visible, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view,
              LampPoints points, LW_INOUT(Gathered) sum) LW_MEMBER {
    Light lamp = light_at(i);
    bool mesh = lamp.type == light_mesh;
    bool beside_rays = leaves_lobe_out(s) && mesh;  // of its lobe, rays see the other part
    vec3 weight = light_power(i) * visible.passed;
    uint samples = mesh ? max(shadow_rays, 1u) : 1u;
    for (uint j = 0u; j < samples; ++j) {
        LightSample light = sample_punctual(lamp, s.position);
        if (has_mesh_lamps && mesh)
            light = sample_mesh(lamp, s.position, lamp_point(points, i, points.round * samples + j));
        float cos_geometric = dot(n_geometric, light.to_light);
        vec3 incoming = weight * light.irradiance / float(samples);
        if (shows_points_behind(s) && !mesh && cos_geometric < 0.0f)
            sum.radiance += transmitted_light(s, n_geometric, n_shading, to_view, light, incoming);
        if (cos_geometric <= 0.0f || max(incoming.x, max(incoming.y, incoming.z)) <= 0.0f) continue;
        if (has_shadow_rays && visible.by_rays)
            incoming *=
                shadow_ray(s.position + n_geometric * ray_epsilon, light.to_light, light.far - 2.0f * ray_epsilon);
        BrdfParts f = brdf_parts(s, n_shading, to_view, light.to_light);
        if (beside_rays) f.specular *= share_of_sample(s, n_shading, to_view, light);
        if (visible.in_cell) f.diffuse = vec3(0.0f);
        if (!visible.in_cell) sum.irradiance += incoming * cos_geometric;
        sum.radiance += incoming * max(dot(n_shading, light.to_light), 0.0f) * (f.diffuse + f.specular);
    }
}

/// What the cell around a place knows of the lamps of a word; 0 when it knows nothing.
uint lamp_bits(GridPlace at, uint word) LW_MEMBER {
    bool has_marks = has_smooth_caustics || has_shadow_masks;
    if (!has_visible_lamps || at.index == no_grid) return 0u;
    return cell_word(at.cell * cell_words(light_count, has_marks) + (has_marks ? 1u : 0u) + word);
}

/// True for a lobe, neither mirror nor wide, whose reflection of mesh lamps is sampled at the lamps too.
bool samples_lobe(Surface s) LW_MEMBER { return leaves_lobe_out(s) && s.roughness * s.roughness >= min_alpha; }

/// One bit per lamp of a word of a cell, at its lowest: set for those of a pair that a pixel has to add. Hidden ones
/// are skipped, and in the cached mode those that the light of the cell holds, unless a lobe is to show them.
uint lamps_to_add(uint bits, uint pair, Surface s) LW_MEMBER {
    uint skipped = lamps_with(bits, some_hidden) & ~lamps_with(bits, some_visible);
    if (shows_points_behind(s)) skipped = 0u;
    if (gather_mode == gather_mode_cached && !samples_lobe(s)) skipped |= lamps_with(bits, in_cell_light);
    uint first = pair * lamps_per_pair;
    uint lamps = min(light_count - min(first, light_count), lamps_per_pair);
    uint all = ((1u << (bits_per_cell_lamp * lamps)) - 1u) << cell_lamp_shift(first);
    return lowest_lamp_bits & ~skipped & all;
}

/// The shadow mask of the first lamp of a word that has one.
uint first_shadow_mask(GridPlace at, uint word) LW_MEMBER {
    if (!has_shadow_masks || !has_visible_lamps || at.index == no_grid) return 0u;
    uint mask = cell_word(at.cell * cell_words(light_count, true)) >> first_mask_shift;
    for (uint before = 0u; before < word; ++before)
        mask += bitCount(lamps_with(lamp_bits(at, before), has_shadow_mask));
    return mask;
}

/// What is known of the lamp whose bits begin at `shift` in its word.
LampVisibility lamp_visibility_in_word(GridPlace at, uint bits, uint shift, uint first_mask, Surface s) LW_MEMBER {
    uint masks_before = uint(bitCount(lamps_with(bits & ((1u << shift) - 1u), has_shadow_mask)));
    return lamp_visibility(cell_lamp_bits(bits, shift), first_mask + masks_before, at.f, s);
}

/// Adds the direct light of one pair of lamps at a place.
void add_direct(GridPlace at, uint pair, Surface s, vec3 n_geometric, vec3 n_shading, vec3 to_view, LampPoints points,
                LW_INOUT(Gathered) sum) LW_MEMBER {
    uint word = cell_lamp_word(pair * lamps_per_pair);
    uint bits = lamp_bits(at, word);
    uint first_mask = first_shadow_mask(at, word);
    for (uint todo = lamps_to_add(bits, pair, s); todo != 0u; todo &= todo - 1u) {
        uint shift = uint(findLSB(todo));
        LampVisibility visible = lamp_visibility_in_word(at, bits, shift, first_mask, s);
        add_lamp(word * cell_lamps_per_word + shift / bits_per_cell_lamp, visible, s, n_geometric, n_shading, to_view,
                 points, sum);
    }
}
