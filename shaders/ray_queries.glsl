// The rays of rays.glsl, traced by the device (GL_EXT_ray_query): geometry 0 is opaque, the triangles of geometry 1 may
// let light through (gpu/acceleration). bvh_triangle_at gives the triangles of both, one after the other.

bool any_see_through() { return first_see_through != no_map; }

/// The triangle with this index in its geometry.
uint queried_triangle(int geometry, int primitive) {
    uint i = uint(primitive) + (geometry == 1 ? first_see_through : 0u);
    return bvh_triangle_at(i) & ~bvh_see_through;
}

/// Fraction of light per RGB that reaches `origin` from distance `far` along unit `direction`.
vec3 shadow_ray(vec3 origin, vec3 direction, float far) {
    uint flags = any_see_through() ? gl_RayFlagsTerminateOnFirstHitEXT
                                   : gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsOpaqueEXT;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, acceleration, flags, 0xffu, origin, 0.0f, direction, max(far, 0.0f));
    vec3 light = vec3(1.0f);
    while (rayQueryProceedEXT(query)) {
        if (!any_see_through()) continue;
        uint triangle = queried_triangle(rayQueryGetIntersectionGeometryIndexEXT(query, false),
                                         rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        light *= passed_by(triangle, rayQueryGetIntersectionBarycentricsEXT(query, false), direction);
        if (max(light.x, max(light.y, light.z)) <= 0.0f) rayQueryConfirmIntersectionEXT(query);
    }
    bool ends = rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
    return ends ? vec3(0.0f) : light;
}

/// The nearest triangle along a ray, holes and glass included, or no_map; sets where it is met.
uint nearest_triangle(vec3 origin, vec3 direction, float far, inout vec2 barycentrics) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, acceleration, gl_RayFlagsOpaqueEXT, 0xffu, origin, 0.0f, direction, max(far, 0.0f));
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return no_map;
    barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return queried_triangle(rayQueryGetIntersectionGeometryIndexEXT(query, true),
                            rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
}
