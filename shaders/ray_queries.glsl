// The functions of rays.glsl by ray queries of the device (GL_EXT_ray_query). Geometry 0 is opaque; triangles of
// geometry 1 may let light through (gpu/acceleration). bvh_triangle_at gives the triangles of geometry 0, then of
// geometry 1.

bool any_see_through() { return first_see_through != no_triangle; }

/// The scene's index of triangle `primitive` of a geometry.
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

/// The nearest triangle along a ray, including holes and glass, or no_triangle. Sets the barycentrics of the hit.
uint nearest_triangle(vec3 origin, vec3 direction, float far, inout vec2 barycentrics) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, acceleration, gl_RayFlagsOpaqueEXT, 0xffu, origin, 0.0f, direction, max(far, 0.0f));
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return no_triangle;
    barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return queried_triangle(rayQueryGetIntersectionGeometryIndexEXT(query, true),
                            rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
}
