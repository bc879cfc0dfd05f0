// The types of lights and what each of them is; the record of a light. One text for C++ and GLSL.
// A new type gets a number here and a case in every `switch` over LightType: in this file, lights.glsl, scene/light.cpp
// and trace/emitter.cpp. C++ code does not compile where a case is missing, and GLSL is the same text. All other code
// asks the functions below what a light is, never which type it has.
#ifndef LW_LIGHT_H
#define LW_LIGHT_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#else
#define LightType uint
#endif

// clang-format off
/// Part of the hash that ties a map to its scene: the numbers stay.
LW_ENUM(LightType)
    light_point = 0u,        // intensity in cd, the same in all directions
    light_spot = 1u,         // intensity in cd inside the inner cone; falls off to the outer one (KHR_lights_punctual)
    light_directional = 2u,  // intensity in lx on a plane facing the light, the same everywhere
    light_mesh = 3u,         // intensity in cd/m2 of the brightest part of a mesh that glows
    light_profile = 4u       // intensity in cd in the strongest direction of its table
LW_ENUM_END;
LW_CONST uint light_type_count = 5u;
// clang-format on

/// A lamp the user can dim. `intensity` is its RGB power in its own unit; photons are stored for intensity 1.
struct Light {
    LightType type;
    vec3 intensity;
    vec3 position;
    vec3 direction;  // unit, the way light travels (spot axis, directional)
    float cos_inner;
    float cos_outer;
    uint first_emitter;  // range in the list of emissive triangles (mesh lights)
    uint emitter_count;
    float area;    // m2 of glowing surface, both sides where both glow (mesh lights)
    vec3 across;   // unit, C0 of the table; `direction` is its aim (profile lights)
    uint profile;  // first number of the table in the array of texels, see profile.glsl
};

/// A triangle of an emissive mesh. Points on a lamp are picked by area: area_below is that of this and all earlier
/// triangles of the lamp, m2, one side.
struct Emitter {
    uint triangle;
    float area_below;
};

/// Light that would arrive at a point from one place of a light, if nothing stood between.
struct LightSample {
    vec3 irradiance;  // on a plane facing the light: that of a delta light, else what the place stands for
    vec3 radiance;    // of the place, towards the point; of a delta light its irradiance
    vec3 to_light;    // unit
    float far;        // distance of the place, m
    float pdf;        // of to_light, by solid angle; 0 for delta lights
};

/// A place on a triangle of a mesh light.
struct LightPlace {
    vec3 position;
    vec3 normal;          // of the front face, of any length
    float normal_length;  // that length
    vec3 emitted;         // cd/m2 at the power of the file
    bool both_sides;      // glows on its back too
};

/// True when a point gets the light from a single direction: one sample is exact, and its shadows are sharp. The light
/// of the other types is a mean over samples, and the nodes of the lattice hold what comes straight from them.
LW_INLINE bool is_delta(LightType type) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return true;
        case light_mesh:
            return false;
    }
    return false;
}

/// True when the light glows on triangles of the scene, which rays meet: a followed ray, or a path from the eye, brings
/// its light by way of mirrors and glass. Of other lights that takes photons, or samples that pass straight on.
LW_INLINE bool has_surface(LightType type) {
    switch (type) {
        case light_mesh:
            return true;
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return false;
    }
    return false;
}

/// True when all light leaves from Light::position. Such a light can be given a photometric file.
LW_INLINE bool is_at_point(LightType type) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return true;
        case light_directional:
        case light_mesh:
            return false;
    }
    return false;
}

/// True when the light comes from outside the scene: it has no position, its flux depends on the size of the scene, and
/// its photons start on a disc around the scene, from most of which they may miss what can be seen.
LW_INLINE bool comes_from_outside(LightType type) {
    switch (type) {
        case light_directional:
            return true;
        case light_point:
        case light_spot:
        case light_mesh:
        case light_profile:
            return false;
    }
    return false;
}

/// True when the intensity is read from a table at Light::profile.
LW_INLINE bool has_table(LightType type) {
    switch (type) {
        case light_profile:
            return true;
        case light_point:
        case light_spot:
        case light_directional:
        case light_mesh:
            return false;
    }
    return false;
}

/// True when the light of a delta light is as good as linear over a lattice cell that is far from the light,
/// sees all of it and is_fully_lit(): then the corners of the cell hold it. A table may bend anywhere.
LW_INLINE bool is_linear_in_cells(LightType type) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_directional:
            return true;
        case light_mesh:
        case light_profile:
            return false;
    }
    return false;
}

/// True where a point gets the whole intensity of a light that is_linear_in_cells(): it is not in the penumbra of a
/// spot's cone or outside it.
LW_INLINE bool is_fully_lit(Light light, vec3 position) {
    switch (light.type) {
        case light_spot:
            return dot(position - light.position, light.direction) / max(length(position - light.position), 1e-30f) >=
                   light.cos_inner;
        case light_point:
        case light_directional:
        case light_mesh:
        case light_profile:
            return true;
    }
    return true;
}

/// A point of a triangle, uniform by area, from two numbers in [0, 1): the weights of the second and third corner.
LW_INLINE vec2 sample_triangle(float u, float v) {
    float root = sqrt(u);
    return vec2(root * (1.0f - v), root * v);
}

/// A glowing triangle that is met at a smaller cosine to its normal counts as edge on: it sends no light.
LW_CONST float min_light_cosine = 1e-6f;

#ifdef __cplusplus
static_assert(sizeof(Emitter) == 8 && sizeof(Light) == 76 && offsetof(Light, profile) == 72);
}  // namespace lw
#endif
#endif
