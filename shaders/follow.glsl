// Followed view paths. From the surface that a pixel shows they go on along specular lobes too narrow for photons,
// through glass and blends, and by way of mirrors, to a surface where light is gathered. Sampling follows
// trace/path_tracer: visible normals (Heitz 2018), one Fresnel factor for both sides, absorption in volumes, blends
// passed at random. One text for C++ and GLSL; needs color.h, followed.h, shade.glsl, rays.glsl and the constants
// has_followed, looks_through, followed_roughness. All loops are bounded, because some devices silently end long ones.

/// A ray of a path, with the weight of the light that it will meet.
struct ViewRay {
    vec3 origin;
    vec3 direction;  // unit
    vec3 weight;
    vec3 medium;     // absorption on the way, 1/m
    float pdf;       // solid angle, of the lobe it was sampled from; 0: light samples do not cover it
    float distance;  // m since that lobe
};

/// The source of a path's random numbers: element `index` of the R2 sequence (Roberts 2018), shifted per pixel.
struct PathNumbers {
    uint seed;
    vec2 shift;
    uint index;
    uint random;  // a hash that is different for each path
};

/// The numbers of a path of a pixel. The shifts in a tile of 4 x 4 pixels form a grid, so that the samples of
/// neighbours fill the unit square evenly.
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

/// The sequence of points on mesh lamps for the end of a path. It differs for each path and depth: with one sequence
/// for microfacets and lamps, their samples would be correlated.
LampPoints points_at_end(uint seed, Following following) LW_MEMBER {
    return first_points(
        hash_uint(seed + 0x9e3779b9u * (1u + following.branch + 2u * following.depth + 8u * following.path)));
}

/// Two numbers in [0, 1) that choose the microfacet at surface number `surface` of a path, counted from 0. They are
/// stratified over the paths at the first surface and random at later ones: the same sequence at two surfaces would
/// correlate their microfacets.
vec2 lobe_numbers(PathNumbers numbers, uint surface) LW_MEMBER {
    bool stratified = surface == 0u;
    uint random = hash_uint(numbers.seed + 0x9e3779b9u * surface + (stratified ? 0u : numbers.random));
    vec2 start = vec2(float(random & 0xffffu), float(random >> 16)) / 65536.0f;
    return !stratified
               ? start
               : fract(start + numbers.shift + float(numbers.index & 0xffffu) * vec2(0.754877666f, 0.569840291f));
}

/// A number in [0, 1) that chooses how a path goes on from surface number `surface`; stratified over the paths at the
/// first two surfaces.
float choice_number(PathNumbers numbers, uint surface) LW_MEMBER {
    bool stratified = surface <= 1u;
    uint random = hash_uint((numbers.seed ^ (0x85ebca6bu * (surface + 1u))) + (stratified ? 0u : numbers.random));
    float start = float(random >> 8) / 16777216.0f;
    if (!stratified) return start;
    start += numbers.shift.x + 0.25f * numbers.shift.y;
    return min(fract(start + float(numbers.index & 0xffffu) * 0.618033989f), 0.99999994f);
}

/// True for a surface whose specular lobe is followed by rays where a pixel shows the surface.
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

/// A microfacet normal, sampled by `u` among those visible from `to_eye`; `n` itself for a mirror.
vec3 microfacet_normal(Surface s, vec3 n, vec3 to_eye, vec2 u) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    if (alpha < min_alpha) return n;
    mat3 basis = basis_around(n);
    float r = sqrt(u.x);
    float phi = 2.0f * lw_pi * u.y;
    return basis * sample_visible_normal(to_eye * basis, alpha, vec2(r * cos(phi), r * sin(phi)));
}

/// The part of the microfacets visible to the eye that the light reaches too: height-correlated Smith G2 / G1; 1 for a
/// mirror. nl, nv: cosines of light and eye to the normal.
float unmasked_part(Surface s, float nl, float nv) LW_MEMBER {
    float alpha = s.roughness * s.roughness;
    if (alpha < min_alpha) return 1.0f;
    float a2 = alpha * alpha;
    float view = sqrt(nv * nv * (1.0f - a2) + a2);
    float light = sqrt(nl * nl * (1.0f - a2) + a2);
    return nl * (nv + view) / max(nl * view + nv * light, 1e-20f);
}

bool is_inside(Seen seen) LW_MEMBER { return !seen.front && refracts(seen.surface); }

/// A ray reflected by the specular lobe. Its weight is 0 when it would leave on the wrong side of the surface.
/// `medium`: absorption of the medium that the path was in.
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

/// Continues the ray `before` straight on behind the surface it met.
ViewRay straight_ray(Seen seen, ViewRay before) LW_MEMBER {
    ViewRay ray = before;
    ray.direction = -seen.to_eye;
    ray.origin = seen.surface.position - seen.n_geometric * ray_epsilon;
    return ray;
}

/// A ray through a thin sheet, or into or out of a volume. Its weight is 0 when the microfacet reflects totally.
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
        ray.weight *= behind > 0.0f ? eta * eta : 0.0f;  // radiance is smaller in the medium of lower index
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

/// The ray to what is behind a surface: straight on past a blend, or transmitted through glass; chosen at random where
/// a surface is both.
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

/// The first ray of a path, from the surface that the pixel shows.
ViewRay first_ray(Seen seen, uint branch, PathNumbers numbers) LW_MEMBER {
    ViewRay ray = no_ray();
    if (branch == branch_through) {
        if (looks_through) ray = ray_behind(seen, numbers);
        return ray;
    }
    ray = reflected_ray(seen, vec3(0.0f), lobe_numbers(numbers, 0u));
    if (has_alpha) ray.weight *= opacity_at(seen.triangle, seen.surface);
    return ray;
}

/// True when a path of this branch goes on from the surface that the pixel shows.
bool goes_on(Seen seen, uint branch) LW_MEMBER {
    if (branch == branch_reflected) return reflects_narrowly(seen.surface);
    return looks_through && (is_glass(seen.surface) || (has_alpha && opacity_at(seen.triangle, seen.surface) < 1.0f));
}

/// The opacity of a surface: the weight of the light that it shows itself, where paths follow what is behind it; else
/// 1.
float shown_part(Seen seen) LW_MEMBER {
    return has_alpha && looks_through ? opacity_at(seen.triangle, seen.surface) : 1.0f;
}

/// True when the pixel reports the illuminance of the surface behind this one.
bool is_looked_through(Seen seen) LW_MEMBER {
    if (!looks_through) return false;
    return (seen.surface.transmission > 0.5f && seen.surface.metallic < 0.5f) || shown_part(seen) < 0.5f;
}

/// The weight of the glow of a surface that a ray met, where the same light is found by samples of its lamp too (power
/// heuristic).
float share_of_ray(Surface s, ViewRay ray) LW_MEMBER {
    if (!has_mesh_lamps || s.light < 0 || ray.pdf <= 0.0f) return 1.0f;
    Light lamp = light_at(uint(s.light));
    if (lamp.type != light_mesh) return 1.0f;
    float by_samples =
        float(max(shadow_rays, 1u)) * point_pdf(lamp, ray.distance, dot(s.geometric_normal, ray.direction));
    float by_rays = float(lobe_paths) * ray.pdf;
    return by_rays * by_rays / max(by_rays * by_rays + by_samples * by_samples, 1e-30f);
}

/// The end of a path, and the glow of the surfaces on its way, weighted, cd/m2.
struct PathEnd {
    Followed at;
    vec3 glow;
};

PathEnd end_nowhere() LW_MEMBER {
    PathEnd end;
    end.at.triangle = no_triangle;
    end.at.barycentrics = vec2(0.0f);
    end.at.eye = vec3(0.0f);
    end.at.weight = vec3(0.0f);
    end.at.flags = 0u;
    end.glow = vec3(0.0f);
    return end;
}

/// The probabilities of the ways in which a path goes on from a surface. They add up to 1, or all are 0.
struct LobeProbabilities {
    float here;  // the path ends: light of the diffuse lobe is gathered, and of small lamps, which no ray meets, by
                 // rough lobes
    float reflected;
    float through;
};

/// The probabilities for the microfacet that `u` samples. They must be those of this microfacet: where one reflects
/// totally, another may transmit.
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

/// Follows a ray by way of mirrors, glass and holes to the first surface whose light can be gathered. `last`: no other
/// path will go on from there.
PathEnd follow(ViewRay ray, PathNumbers numbers, bool last) LW_MEMBER {
    PathEnd end = end_nowhere();
    for (uint met = 1u; met <= max_followed_surfaces; ++met) {
        if (!(largest(ray.weight) > 0.0f)) return end;
        vec2 barycentrics = vec2(0.0f);
        uint triangle = nearest_triangle(ray.origin, ray.direction, 2.0f * scene_size, barycentrics);
        if (triangle == no_triangle) return end;
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
            if (!has_direct) ray.pdf = 0.0f;  // no lamp samples find the same light
        }
    }
    return end;
}

/// The surface at the end of a path, marked when its specular lobe must be left out.
Seen see_followed(Followed at) LW_MEMBER {
    Seen seen = see(at.triangle, at.barycentrics, at.eye);
    if ((at.flags & followed_leaves_lobe) != 0u) seen.surface.flags |= lobe_is_followed;
    return seen;
}

/// Marks a surface that a pixel shows, so that estimates leave out the lobe that rays follow.
Seen marked(Seen seen) LW_MEMBER {
    if (reflects_narrowly(seen.surface)) seen.surface.flags |= lobe_is_followed;
    return seen;
}

/// Adds the light of one path of a branch from the surface `seen` that the pixel shows.
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
        if (at.triangle == no_triangle) return;
        following.depth = depth;
        Seen far = see_followed(at);
        Gathered shown = estimate_at(far);
        for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
            add_rays(far, pair, points_at_end(seed, following), shown);
        light.radiance += at.weight * shown.radiance;
        if (depth == 0u && branch == branch_through && is_looked_through(seen)) light.irradiance += shown.irradiance;
        if ((at.flags & followed_goes_on) == 0u) return;
        following.depth = depth + 1u;
        numbers = path_numbers(pixel, following, 0u);
        ViewRay ray = reflected_ray(far, vec3(0.0f), lobe_numbers(numbers, 0u));
        ray.weight *= at.weight;
        end = follow(ray, numbers, depth + 2u == max_lobes);
    }
}

/// All light from the point (triangle, barycentrics) towards `eye`. Illuminance, bandwidth and photons are those at
/// that point. `seed` chooses points on mesh lamps, `pixel` the paths.
Gathered shade(uint triangle, vec2 barycentrics, vec3 eye, uint seed, uvec2 pixel) LW_MEMBER {
    Seen seen = marked(see(triangle, barycentrics, eye));
    Gathered light = estimate_at(seen);
    light.radiance += own_radiance(seen.surface, seen.front);
    for (uint pair = 0u; has_direct && pair < ray_pairs(light_count); ++pair)
        add_rays(seen, pair, first_points(seed), light);
    light.radiance *= shown_part(seen);
    if (is_looked_through(seen)) light.irradiance = vec3(0.0f);
    for (uint branch = 0u; has_followed && branch < branch_count; ++branch)
        if (goes_on(seen, branch)) add_followed(seen, branch, pixel, seed, light);
    return light;
}
