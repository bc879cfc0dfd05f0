// Light that arrives at a point from a sampled place of a light, for each type. One text for C++ and GLSL; needs
// light.h, profile.glsl and surface.glsl. The including scope provides the array emitters and the constants
// has_area_lamps, has_profiles, has_emissive_textures, has_alpha and scene_size (m). All light is for intensity 1 of
// the lamp: per cd, lx or cd/m2 of each RGB channel.

/// The intensity of a spot light at a cosine to its axis: squared and linear in the cosine between the cones, as
/// KHR_lights_punctual.
float spot_falloff(Light lamp, float cosine) LW_MEMBER {
    float width = max(lamp.cos_inner - lamp.cos_outer, 1e-6f);
    float t = clamp((cosine - lamp.cos_outer) / width, 0.0f, 1.0f);
    return t * t;
}

/// E = I / d^2 of a light that is_at_point(), in a unit `direction` from it and at the squared distance `d2`, m2.
float irradiance_from_point(Light lamp, vec3 direction, float d2) LW_MEMBER {
    switch (lamp.type) {
        case light_spot:
            return spot_falloff(lamp, dot(direction, lamp.direction)) / d2;
        case light_profile:
            return has_profiles ? 1.0f / d2 * profile_value(lamp, direction) : 0.0f;
        case light_point:
            return 1.0f / d2;
        case light_directional:
        case light_mesh:
            return 0.0f;  // has no position
    }
    return 0.0f;
}

/// The light at `position` of a light that is_at_point().
LightSample sample_from_point(Light lamp, vec3 position) LW_MEMBER {
    vec3 path = lamp.position - position;
    float d2 = max(dot(path, path), 1e-30f);
    LightSample result;
    result.far = sqrt(d2);
    result.to_light = path / result.far;
    result.irradiance = vec3(irradiance_from_point(lamp, -result.to_light, d2));
    result.radiance = result.irradiance;
    result.pdf = 0.0f;
    return result;
}

/// The light of a light that comes_from_outside(), the same everywhere.
LightSample sample_directional(Light lamp) LW_MEMBER {
    LightSample result;
    result.far = scene_size;
    result.to_light = -lamp.direction;
    result.irradiance = vec3(1.0f);
    result.radiance = vec3(1.0f);
    result.pdf = 0.0f;
    return result;
}

/// The area of the surface that a light glows on, m2, one side; 0 of a light without a surface.
float area_of_surface(Light lamp) LW_MEMBER {
    switch (lamp.type) {
        case light_mesh:
            return emitters[lamp.first_emitter + lamp.emitter_count - 1u].area_below;
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return 0.0f;
    }
    return 0.0f;
}

/// The triangle of a mesh light in which a share `u` of its area ends, and in `within` how far into it, in [0, 1).
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

/// Solid-angle pdf with which sample_mesh() picks a place that is met from `distance` at `cosine` to its normal; 0
/// where it is met edge on.
float mesh_pdf(Light lamp, float distance, float cosine) LW_MEMBER {
    float area = area_of_surface(lamp);
    return abs(cosine) > min_light_cosine ? distance * distance / (area * abs(cosine)) : 0.0f;
}

/// A value that a mesh emits, per unit intensity of its lamp.
vec3 per_intensity(Light lamp, vec3 emitted) LW_MEMBER { return emitted / max(lamp.intensity, vec3(1e-20f)); }

/// The light of one place of a mesh, picked uniformly by area: E = L A cos / d^2 with the cosine at the place.
LightSample sample_from_place(Light lamp, vec3 position, LightPlace place) LW_MEMBER {
    vec3 path = place.position - position;
    float d2 = max(dot(path, path), 1e-30f);
    LightSample result;
    result.far = sqrt(d2);
    result.to_light = path / result.far;
    float cosine = -dot(place.normal, result.to_light) / max(place.normal_length, 1e-30f);
    if (place.both_sides) cosine = abs(cosine);
    result.radiance = cosine > min_light_cosine ? per_intensity(lamp, place.emitted) : vec3(0.0f);
    result.irradiance = result.radiance * (area_of_surface(lamp) * max(cosine, 0.0f) / d2);
    result.pdf = mesh_pdf(lamp, result.far, cosine);
    return result;
}

/// A place on a glowing triangle. `barycentrics`: the weights of its second and third corner.
LightPlace place_on_triangle(uint triangle, vec2 barycentrics) LW_MEMBER {
    vec3 a = corner_position(triangle, 0u);
    vec3 ab = corner_position(triangle, 1u) - a;
    vec3 ac = corner_position(triangle, 2u) - a;
    Material material = material_of(triangle);
    LightPlace place;
    place.position = a + barycentrics.x * ab + barycentrics.y * ac;
    place.normal = cross(ab, ac);
    place.normal_length = length(place.normal);
    place.emitted = material.emissive;
    place.both_sides = (material.flags & material_double_sided) != 0u;
    if (has_emissive_textures || has_alpha) {
        Surface there = surface_at(triangle, barycentrics);
        place.emitted = there.emissive * opacity_at(triangle, there);  // holes do not glow
    }
    return place;
}

/// The light at `position` from a place of a mesh that two numbers in [0, 1) pick, uniform by area.
LightSample sample_mesh(Light lamp, vec3 position, vec2 u) LW_MEMBER {
    float within = 0.0f;
    uint triangle = pick_emitter(lamp, u.x, within);
    return sample_from_place(lamp, position, place_on_triangle(triangle, sample_triangle(within, u.y)));
}

/// Light that arrives at `position` from a place of the light that two numbers in [0, 1) pick; delta lights need none.
LightSample sample_light(Light lamp, vec3 position, vec2 u) LW_MEMBER {
    switch (lamp.type) {
        case light_point:
        case light_spot:
        case light_profile:
            return sample_from_point(lamp, position);
        case light_mesh:
            if (has_area_lamps) return sample_mesh(lamp, position, u);
            break;
        case light_directional:
            break;
    }
    return sample_directional(lamp);
}

/// Solid-angle pdf with which sample_light() picks a surface of the light that a ray meets after `distance` at `cosine`
/// to its normal.
float light_pdf(Light lamp, float distance, float cosine) LW_MEMBER {
    switch (lamp.type) {
        case light_mesh:
            return mesh_pdf(lamp, distance, cosine);
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return 0.0f;  // has no surface
    }
    return 0.0f;
}
