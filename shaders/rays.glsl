// Rays through the hierarchy of shaders/bvh.h: shadow rays and the nearest triangle. One text for C++ and GLSL; the
// including scope provides what surface.glsl and bsdf.glsl need, the functions bvh_node_at, bvh_triangle_at and the
// constants bvh_node_count, has_alpha, has_transmission. The traversal holds no costly code, because some devices run
// both sides of every branch.

/// True when a triangle is crossed by origin + t direction, 0 < t < far (Moeller & Trumbore 1997, edges included); sets
/// `hit` to the weights of its second and third corner and t.
bool crosses_triangle(uint triangle, vec3 origin, vec3 direction, float far, LW_INOUT(vec3) hit) LW_MEMBER {
    vec3 a = corner_position(triangle, 0u);
    vec3 ab = corner_position(triangle, 1u) - a;
    vec3 ac = corner_position(triangle, 2u) - a;
    vec3 p = cross(direction, ac);
    float determinant = dot(ab, p);
    if (determinant == 0.0f) return false;
    float inverse = 1.0f / determinant;
    vec3 to_origin = origin - a;
    float u = dot(to_origin, p) * inverse;
    vec3 q = cross(to_origin, ab);
    float v = dot(direction, q) * inverse;
    float t = dot(ac, q) * inverse;
    hit = vec3(u, v, t);
    return u >= -1e-6f && v >= -1e-6f && u + v <= 1.000001f && t > 0.0f && t < far;
}

/// The state of a traversal: the entries [first, last) of the triangle list are tested next, then node `node`.
struct Traversal {
    uint node;
    uint first;
    uint last;
};

/// Continues a traversal to the next triangle that the ray crosses. Returns its entry with the bvh_see_through bit, or
/// no_triangle at the end.
uint next_crossed(vec3 origin, vec3 direction, vec3 inverse, float far, LW_INOUT(Traversal) at,
                  LW_INOUT(vec3) hit) LW_MEMBER {
    while (at.first < at.last || at.node < bvh_node_count) {
        if (at.first < at.last) {
            uint entry = bvh_triangle_at(at.first++);
            if (crosses_triangle(entry & ~bvh_see_through, origin, direction, far, hit)) return entry;
            continue;
        }
        BvhNode n = bvh_node_at(at.node);
        vec3 t0 = (n.low - origin) * inverse;
        vec3 t1 = (n.high - origin) * inverse;
        vec3 near3 = min(t0, t1);
        vec3 far3 = max(t0, t1) * 1.000001f;  // Ize 2013: keeps edges of boxes watertight
        bool inside = max(max(near3.x, near3.y), max(near3.z, 0.0f)) <= min(min(far3.x, far3.y), min(far3.z, far));
        at.first = n.leaf >> 4;
        at.last = inside ? at.first + (n.leaf & 15u) : at.first;
        at.node = inside && n.leaf == 0u ? at.node + 1u : n.skip;
    }
    return no_triangle;
}

/// 1 / direction, finite.
vec3 inverse_of(vec3 direction) LW_MEMBER {
    float tiny = 1e-20f;
    return 1.0f / vec3(abs(direction.x) > tiny ? direction.x : tiny, abs(direction.y) > tiny ? direction.y : tiny,
                       abs(direction.z) > tiny ? direction.z : tiny);
}

Traversal start_traversal() LW_MEMBER {
    Traversal at;
    at.node = 0u;
    at.first = 0u;
    at.last = 0u;
    return at;
}

/// Fraction of light per RGB that reaches `origin` from distance `far` along unit `direction`.
vec3 shadow_ray(vec3 origin, vec3 direction, float far) LW_MEMBER {
    vec3 inverse = inverse_of(direction);
    Traversal at = start_traversal();
    vec3 hit = vec3(0.0f);
    vec3 light = vec3(1.0f);
    uint entry = next_crossed(origin, direction, inverse, far, at, hit);
    if (!has_alpha && !has_transmission) return entry == no_triangle ? light : vec3(0.0f);
    while (entry != no_triangle) {
        if ((entry & bvh_see_through) == 0u) return vec3(0.0f);
        light *= passed_by(entry & ~bvh_see_through, vec2(hit.x, hit.y), direction);
        if (max(light.x, max(light.y, light.z)) <= 0.0f) return vec3(0.0f);
        entry = next_crossed(origin, direction, inverse, far, at, hit);
    }
    return light;
}

/// The nearest triangle along a ray, including holes and glass, or no_triangle. Sets the barycentrics of the hit.
uint nearest_triangle(vec3 origin, vec3 direction, float far, LW_INOUT(vec2) barycentrics) LW_MEMBER {
    vec3 inverse = inverse_of(direction);
    Traversal at = start_traversal();
    vec3 hit = vec3(0.0f);
    uint nearest = no_triangle;
    uint entry = next_crossed(origin, direction, inverse, far, at, hit);
    while (entry != no_triangle) {
        nearest = entry & ~bvh_see_through;
        barycentrics = vec2(hit.x, hit.y);
        far = hit.z;
        entry = next_crossed(origin, direction, inverse, far, at, hit);
    }
    return nearest;
}
