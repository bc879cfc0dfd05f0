// View paths that go on from what the eye sees: along specular lobes too narrow for photons, through glass and blends,
// by way of mirrors, to the surface where light is gathered. Conventions are those of trace/path_tracer: Heitz's
// visible normals, one Fresnel factor for both sides, absorption in volumes, alpha by chance. One text for C++ and
// GLSL; needs followed.h, shade.glsl, rays.glsl and the constants has_followed, follows_through, followed_roughness.
// Loops are bounded: some devices end long ones without a word.

/// A ray on its way, and what the light it meets counts.
struct ViewRay {
    vec3 origin;
    vec3 direction;  // unit
    vec3 weight;
    vec3 medium;     // absorption on the way, 1/m
    float pdf;       // solid angle, of the lobe it was sampled from; 0: light samples do not cover it
    float distance;  // m since that lobe
};

/// Low-discrepancy numbers of a path: element `index` of the R2 sequence (Roberts 2018), shifted.
struct PathNumbers {
    uint seed;
    vec2 shift;
    uint index;
    uint random;  // of this path alone
};

/// The shifts of a tile of 4 x 4 pixels are a grid, so that neighbours complete each other.
PathNumbers path_numbers(uvec2 pixel, Following following, uint sample_index) LW_MEMBER {
    PathNumbers numbers;
    numbers.shift = vec2(float((pixel.x + 2u * pixel.y) & 3u), float((pixel.y + 2u * pixel.x) & 3u)) / 4.0f;
    numbers.seed =
        hash_uint(pixel.x / 4u + 4096u * (pixel.y / 4u) + 0x01000193u * (following.branch + 2u * following.depth));
    numbers.index = sample_index * following.paths + following.path;
    numbers.random =
        hash_uint(numbers.seed + hash_uint(numbers.index + 65536u * (4u * (pixel.x & 3u) + (pixel.y & 3u))));
    return numbers;
}

/// The points on mesh lamps at the end of a path: apart for each, as one sequence for the facets and the lamps beyond
/// would pair them.
LampPoints points_at_end(uint seed, Following following) LW_MEMBER {
    return first_points(
        hash_uint(seed + 0x9e3779b9u * (1u + following.branch + 2u * following.depth + 8u * following.path)));
}

/// For the facet of the surface before which `surface` others were met: stratified over the paths at the first one,
/// random at the others, as the same sequence at two of them would pair their facets.
vec2 lobe_numbers(PathNumbers numbers, uint surface) LW_MEMBER {
    bool stratified = surface == 0u;
    uint random = hash_uint(numbers.seed + 0x9e3779b9u * surface + (stratified ? 0u : numbers.random));
    vec2 start = vec2(float(random & 0xffffu), float(random >> 16)) / 65536.0f;
    return !stratified
               ? start
               : fract(start + numbers.shift + float(numbers.index & 0xffffu) * vec2(0.754877666f, 0.569840291f));
}

/// For the way on from a surface, in [0, 1): stratified at the first two.
float choice_number(PathNumbers numbers, uint surface) LW_MEMBER {
    bool stratified = surface <= 1u;
    uint random = hash_uint((numbers.seed ^ (0x85ebca6bu * (surface + 1u))) + (stratified ? 0u : numbers.random));
    float start = float(random >> 8) / 16777216.0f;
    if (!stratified) return start;
    start += numbers.shift.x + 0.25f * numbers.shift.y;
    return min(fract(start + float(numbers.index & 0xffffu) * 0.618033989f), 0.99999994f);
}

float largest(vec3 v) LW_MEMBER { return max(v.x, max(v.y, v.z)); }

/// True for a surface whose specular lobe is followed by rays when the eye sees it.
bool reflects_narrowly(Surface s) LW_MEMBER {
    return has_followed && s.roughness < followed_roughness && (s.metallic > 0.0f || s.specular > 0.0f) &&
           (s.flags & material_unlit) == 0u;
}

bool is_glass(Surface s) LW_MEMBER { return has_transmission && s.transmission > 0.0f && s.metallic < 1.0f; }

/// Orthonormal basis around unit n as columns (Duff et al. 2017).
mat3 basis_around(vec3 n) LW_MEMBER {
    float side = n.z < 0.0f ? -1.0f : 1.0f;
    float a = -1.0f / (side + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x), vec3(b, side + n.y * n.y * a, -n.y), n);
}

/// The normal of a facet that the eye sees: of a mirror `n` itself.
vec3 microfacet_normal(Surface s, vec3 n, vec3 to_eye, vec2 u) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    if (alpha < min_alpha) return n;
    mat3 basis = basis_around(n);
    float r = sqrt(u.x);
    float phi = 2.0f * lw_pi * u.y;
    return basis * sample_visible_normal(to_eye * basis, alpha, vec2(r * cos(phi), r * sin(phi)));
}

/// The part of the facets the eye sees that see the light too: height-correlated Smith G2 / G1; 1 for a mirror.
float unmasked_part(Surface s, float nl, float nv) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    if (alpha < min_alpha) return 1.0f;
    float a2 = alpha * alpha;
    float view = sqrt(nv * nv * (1.0f - a2) + a2);
    float light = sqrt(nl * nl * (1.0f - a2) + a2);
    return nl * (nv + view) / max(nl * view + nv * light, 1e-20f);
}

bool is_inside(Seen seen) LW_MEMBER { return !seen.front && refracts(seen.surface); }

/// A ray along the reflecting lobe; weight 0 where it would leave by the wrong side.
ViewRay reflected_ray(Seen seen, vec3 medium, vec2 u) LW_MEMBER {
    Surface s = seen.surface;
    vec3 n = seen.n_shading;
    vec3 h = microfacet_normal(s, n, seen.to_eye, u);
    float vh = dot(h, seen.to_eye);
    float nv = max(dot(n, seen.to_eye), 1e-4f);
    ViewRay ray;
    ray.direction = normalize(2.0f * vh * h - seen.to_eye);
    float nl = dot(n, ray.direction);
    bool leaves = nl > 0.0f && dot(seen.n_geometric, ray.direction) > 0.0f;
    ray.origin = s.position + seen.n_geometric * ray_epsilon;
    ray.weight =
        leaves ? specular_reflectance(s, max(vh, 1e-4f), is_inside(seen)) * unmasked_part(s, nl, nv) : vec3(0.0f);
    ray.medium = is_inside(seen) ? s.absorption : (refracts(s) ? vec3(0.0f) : medium);
    ray.pdf = lobe_pdf(s, n, seen.to_eye, ray.direction);
    ray.distance = 0.0f;
    return ray;
}

/// The ray `before` that arrived, or would arrive, at a surface, straight on behind it.
ViewRay straight_ray(Seen seen, ViewRay before) LW_MEMBER {
    ViewRay ray = before;
    ray.direction = -seen.to_eye;
    ray.origin = seen.surface.position - seen.n_geometric * ray_epsilon;
    return ray;
}

/// A ray through a sheet or into or out of a volume; weight 0 where facets reflect totally.
ViewRay transmitted_ray(Seen seen, ViewRay before, vec2 u) LW_MEMBER {
    Surface s = seen.surface;
    vec3 n = seen.n_shading;
    vec3 h = transmits_smoothly(s) ? n : microfacet_normal(s, n, seen.to_eye, u);
    float vh = max(dot(h, seen.to_eye), 1e-4f);
    float nv = max(dot(n, seen.to_eye), 1e-4f);
    bool inside = is_inside(seen);
    ViewRay ray = straight_ray(seen, before);
    ray.weight *= transmitted_part(s, vh, inside);
    if (passes_straight(s)) return ray;
    if (refracts(s)) {
        float eta = inside ? s.ior : 1.0f / s.ior;
        float behind = refracted_cosine(vh, eta);
        ray.direction = normalize((eta * vh - behind) * h - eta * seen.to_eye);
        ray.weight *= behind > 0.0f ? eta * eta : 0.0f;  // radiance is smaller in the thinner medium
        ray.medium = inside ? vec3(0.0f) : s.absorption;
    } else {
        vec3 reflected = 2.0f * vh * h - seen.to_eye;
        ray.direction = normalize(reflected - 2.0f * dot(reflected, n) * n);
        if (dot(reflected, n) <= 0.0f) ray.weight = vec3(0.0f);
    }
    float nl = -dot(n, ray.direction);
    if (nl <= 0.0f || dot(seen.n_geometric, ray.direction) >= 0.0f) ray.weight = vec3(0.0f);
    if (!transmits_smoothly(s)) ray.weight *= unmasked_part(s, max(nl, 0.0f), nv);
    ray.pdf = 0.0f;
    ray.distance = 0.0f;
    return ray;
}

ViewRay no_ray() LW_MEMBER {
    ViewRay ray;
    ray.origin = vec3(0.0f);
    ray.direction = vec3(0.0f, 0.0f, 1.0f);
    ray.weight = vec3(1.0f);
    ray.medium = vec3(0.0f);
    ray.pdf = 0.0f;
    ray.distance = 0.0f;
    return ray;
}

/// What the eye sees through a surface: straight on past a blend, or through glass, by chance where it is both.
ViewRay ray_behind(Seen seen, PathNumbers numbers) LW_MEMBER {
    Surface s = seen.surface;
    float there = opacity_at(seen.triangle, s);
    float glass = is_glass(s) ? there * s.transmission * (1.0f - s.metallic) : 0.0f;
    float sum = 1.0f - there + glass;
    bool past = choice_number(numbers, 0u) * sum < 1.0f - there;
    ViewRay ray = no_ray();
    if (past)
        ray = straight_ray(seen, ray);
    else
        ray = transmitted_ray(seen, ray, lobe_numbers(numbers, 0u));
    ray.weight *= sum <= 0.0f ? 0.0f : (past ? sum : there * sum / max(glass, 1e-20f));
    return ray;
}

/// The first ray of a path from what the eye sees.
ViewRay first_ray(Seen seen, uint branch, PathNumbers numbers) LW_MEMBER {
    ViewRay ray = no_ray();
    if (branch == branch_through) {
        if (follows_through) ray = ray_behind(seen, numbers);
        return ray;
    }
    ray = reflected_ray(seen, vec3(0.0f), lobe_numbers(numbers, 0u));
    if (has_alpha) ray.weight *= opacity_at(seen.triangle, seen.surface);
    return ray;
}

/// True when a path goes on from what the eye sees.
bool goes_on(Seen seen, uint branch) LW_MEMBER {
    if (branch == branch_reflected) return reflects_narrowly(seen.surface);
    return follows_through && (is_glass(seen.surface) || (has_alpha && opacity_at(seen.triangle, seen.surface) < 1.0f));
}

/// The part of a surface that is there: what it shows itself counts so much.
float shown_part(Seen seen) LW_MEMBER {
    return has_alpha && follows_through ? opacity_at(seen.triangle, seen.surface) : 1.0f;
}

/// True where the illuminance of a pixel is that of the surface behind.
bool is_followed_through(Seen seen) LW_MEMBER {
    if (!follows_through) return false;
    return (seen.surface.transmission > 0.5f && seen.surface.metallic < 0.5f) || shown_part(seen) < 0.5f;
}

/// What a glowing surface met by a ray counts beside light samples of its lamp (power heuristic).
float share_of_ray(Surface s, ViewRay ray) LW_MEMBER {
    if (!has_mesh_lamps || s.light < 0 || ray.pdf <= 0.0f) return 1.0f;
    Light lamp = light_at(uint(s.light));
    if (lamp.type != light_mesh) return 1.0f;
    float by_samples =
        float(max(shadow_rays, 1u)) * point_pdf(lamp, ray.distance, dot(s.geometric_normal, ray.direction));
    float by_rays = float(lobe_paths) * ray.pdf;
    return by_rays * by_rays / max(by_rays * by_rays + by_samples * by_samples, 1e-30f);
}

/// Where a path ends, and the light of the glowing surfaces on its way.
struct PathEnd {
    Followed at;
    vec3 glow;
};

PathEnd end_nowhere() LW_MEMBER {
    PathEnd end;
    end.at.triangle = no_map;
    end.at.barycentrics = vec2(0.0f);
    end.at.eye = vec3(0.0f);
    end.at.weight = vec3(0.0f);
    end.at.flags = 0u;
    end.glow = vec3(0.0f);
    return end;
}

/// How likely a path goes on from a surface by each way, in sum 1, or all 0.
struct LobeProbabilities {
    float here;  // not at all: the light of the diffuse lobe is gathered, and of small lamps, which no ray meets, by
                 // rough ones
    float reflected;
    float through;
};

/// By what the facet does that the lobes sample with `u`: beside one that reflects totally, others may pass.
LobeProbabilities lobe_probabilities(Seen seen, vec2 u) LW_MEMBER {
    Surface s = seen.surface;
    float nv = max(dot(microfacet_normal(s, seen.n_shading, seen.to_eye, u), seen.to_eye), 1e-4f);
    vec3 fresnel = dielectric_fresnel(s, nv, is_inside(seen));
    LobeProbabilities chance;
    chance.here =
        largest(s.base_color) * max(passed_by_fresnel(fresnel), 0.0f) * (1.0f - s.transmission) * (1.0f - s.metallic);
    chance.reflected = largest(specular_reflectance(s, nv, is_inside(seen)));
    chance.through = has_transmission ? largest(transmitted_part(s, nv, is_inside(seen))) : 0.0f;
    if (has_direct && s.roughness * s.roughness >= min_alpha)
        chance.here = max(chance.here, min_part_here * (chance.reflected + chance.through));
    float sum = max(chance.here + chance.reflected + chance.through, 1e-20f);
    chance.here /= sum;
    chance.reflected /= sum;
    chance.through /= sum;
    return chance;
}

/// Follows a ray by way of mirrors, glass and holes to the first surface that shows light of its own lobes. `last`: no
/// path goes on from there.
PathEnd follow(ViewRay ray, PathNumbers numbers, bool last) LW_MEMBER {
    PathEnd end = end_nowhere();
    for (uint met = 1u; met <= max_followed_surfaces; ++met) {
        if (!(largest(ray.weight) > 0.0f)) return end;
        vec2 barycentrics = vec2(0.0f);
        uint triangle = nearest_triangle(ray.origin, ray.direction, 2.0f * scene_size, barycentrics);
        if (triangle == no_map) return end;
        Seen seen = see(triangle, barycentrics, ray.origin);
        seen.to_eye = -ray.direction;
        Surface s = seen.surface;
        float way = length(s.position - ray.origin);
        ray.distance += way;
        if (has_transmission) ray.weight *= passed_by_medium(is_inside(seen) ? s.absorption : ray.medium, way);
        float there = opacity_at(triangle, s);
        float choice = choice_number(numbers, met);
        if (choice >= there) {
            ray = straight_ray(seen, ray);
            continue;
        }
        choice /= there;
        end.glow += ray.weight * own_radiance(s, seen.front) * share_of_ray(s, ray);
        if ((s.flags & material_unlit) != 0u) return end;
        vec2 u = lobe_numbers(numbers, met);
        LobeProbabilities chance = lobe_probabilities(seen, u);
        bool smooth_lobe = s.roughness * s.roughness < min_alpha;
        bool passes = is_glass(s) || (smooth_lobe && s.metallic > 0.5f);
        if (!passes || (choice >= chance.through + chance.reflected && chance.here > 1e-4f)) {
            end.at.triangle = triangle;
            end.at.barycentrics = barycentrics;
            end.at.eye = ray.origin;
            end.at.weight = passes ? ray.weight / chance.here : ray.weight;
            bool on = !passes && !last && !smooth_lobe && reflects_narrowly(s) && chance.reflected > strong_lobe;
            end.at.flags = (passes ? followed_leaves_lobe : 0u) | (on ? followed_goes_on | followed_leaves_lobe : 0u);
            return end;
        }
        vec3 weight = ray.weight;
        if (choice < chance.through) {
            ray = transmitted_ray(seen, ray, u);
            ray.weight /= chance.through;
        } else {
            ray = reflected_ray(seen, ray.medium, u);
            ray.weight *= weight / chance.reflected;
            if (!has_direct) ray.pdf = 0.0f;  // no light samples beside it
        }
    }
    return end;
}

/// A place that a path came to.
Seen see_followed(Followed at) LW_MEMBER {
    Seen seen = see(at.triangle, at.barycentrics, at.eye);
    if ((at.flags & followed_leaves_lobe) != 0u) seen.surface.flags |= lobe_is_followed;
    return seen;
}

/// Marks what the eye sees, for estimates to leave out what rays bring.
Seen marked(Seen seen) LW_MEMBER {
    if (reflects_narrowly(seen.surface)) seen.surface.flags |= lobe_is_followed;
    return seen;
}

/// Adds what one path of a branch brings when the eye sees `seen` in `pixel`.
void add_followed(Seen seen, uint branch, uvec2 pixel, uint seed, LW_INOUT(Gathered) light) LW_MEMBER {
    Following following;
    following.branch = branch;
    following.depth = 0u;
    following.path = 0u;
    following.paths = 1u;
    PathNumbers numbers = path_numbers(pixel, following, 0u);
    PathEnd end = follow(first_ray(seen, branch, numbers), numbers, false);
    for (uint depth = 0u; depth < max_lobes; ++depth) {
        light.radiance += end.glow;
        Followed at = end.at;
        if (at.triangle == no_map) return;
        following.depth = depth;
        Seen far = see_followed(at);
        Gathered shown = estimate_at(far);
        for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
            add_rays(far, pair, points_at_end(seed, following), shown);
        light.radiance += at.weight * shown.radiance;
        if (depth == 0u && branch == branch_through && is_followed_through(seen)) light.irradiance += shown.irradiance;
        if ((at.flags & followed_goes_on) == 0u) return;
        following.depth = depth + 1u;
        numbers = path_numbers(pixel, following, 0u);
        ViewRay ray = reflected_ray(far, vec3(0.0f), lobe_numbers(numbers, 0u));
        ray.weight *= at.weight;
        end = follow(ray, numbers, depth + 2u == max_lobes);
    }
}

/// All light towards `eye` from (triangle, barycentrics), seen in `pixel`; illuminance, bandwidth and photons are of
/// that place.
Gathered shade(uint triangle, vec2 barycentrics, vec3 eye, uint seed, uvec2 pixel) LW_MEMBER {
    Seen seen = marked(see(triangle, barycentrics, eye));
    Gathered light = estimate_at(seen);
    light.radiance += own_radiance(seen.surface, seen.front);
    for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
        add_rays(seen, pair, first_points(seed), light);
    light.radiance *= shown_part(seen);
    if (is_followed_through(seen)) light.irradiance = vec3(0.0f);
    for (uint branch = 0u; has_followed && branch < branch_count; ++branch)
        if (goes_on(seen, branch)) add_followed(seen, branch, pixel, seed, light);
    return light;
}
