#include "trace/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/error.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr int max_layers = 256;  // most holes and sheets of glass along a ray

RTCScene as_scene(void* handle) { return static_cast<RTCScene>(handle); }

/// A ray for Embree. Its members are written 16 bytes at a time, as Embree reads them: a wide load after several narrow
/// stores would wait for them.
RTCRay make_ray(vec3 origin, vec3 direction, float far) {
    using Floats = float __attribute__((vector_size(16)));
    const Floats from{origin.x, origin.y, origin.z, 0}, along{direction.x, direction.y, direction.z, 0};
    RTCRay ray;
    static_assert(offsetof(RTCRay, org_x) == 0 && offsetof(RTCRay, tnear) == 12 && offsetof(RTCRay, dir_x) == 16 &&
                  offsetof(RTCRay, time) == 28);
    std::memcpy(&ray.org_x, &from, sizeof from);
    std::memcpy(&ray.dir_x, &along, sizeof along);
    ray.tfar = far, ray.mask = 0xffffffffu, ray.id = 0, ray.flags = 0;
    return ray;
}

void intersect(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
}

bool occluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0;
}

/// The data of a point query. Embree offers the triangles of all leaves near the point; collect() keeps those within
/// the radius.
struct Collected {
    const Scene& scene;
    vec3 point;
    float radius;
    size_t most;
    std::vector<uint>& found;
    bool complete = true;
};

bool collect(RTCPointQueryFunctionArguments* arguments) {
    auto& collected = *static_cast<Collected*>(arguments->userPtr);
    const uvec3 c = collected.scene.triangles[arguments->primID];
    const std::vector<vec3>& at = collected.scene.positions;
    const vec3 path = closest_point_on_triangle(collected.point, at[c.x], at[c.y], at[c.z]) - collected.point;
    if (dot(path, path) > collected.radius * collected.radius) return false;
    collected.complete = collected.found.size() < collected.most;
    if (collected.complete)
        collected.found.push_back(arguments->primID);
    else
        arguments->query->radius = 0;  // ends the query
    return !collected.complete;
}

}  // namespace

RayCaster::RayCaster(const Scene& scene) : scene_(scene), surfaces_(scene) {
    RTCDevice device = rtcNewDevice(nullptr);
    if (!device) throw Error("Embree: no device could be created");
    device_ = device;
    RTCScene embree_scene = rtcNewScene(device);
    embree_scene_ = embree_scene;
    rtcSetSceneFlags(embree_scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree_scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes of the last vertex, so it gets its own padded copy.
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 sizeof(vec3), scene.positions.size()));
    auto* indices = static_cast<uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                sizeof(uvec3), scene.triangles.size()));
    if (!vertices || !indices) throw Error(scene.path.filename().string() + ": not enough memory for the ray caster");
    std::copy_n(&scene.positions.data()->x, 3 * scene.positions.size(), vertices);
    std::copy(scene.triangles.begin(), scene.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        throw Error(scene.path.filename().string() + ": Embree could not build its hierarchy");

    epsilon_ = scene.ray_epsilon();
    for (const Material& m : scene.materials) {
        has_holes_ |= (m.flags & (material_alpha_mask | material_alpha_blend)) != 0;
        has_thin_glass_ |= (m.flags & material_thin) != 0;
    }
}

RayCaster::~RayCaster() {
    if (embree_scene_) rtcReleaseScene(as_scene(embree_scene_));
    if (device_) rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

std::optional<Hit> RayCaster::nearest_triangle(vec3 origin, vec3 direction, float max_distance) const {
    RTCRayHit query;
    query.ray = make_ray(origin, direction, max_distance);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(as_scene(embree_scene_), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.hit.primID, {query.hit.u, query.hit.v}, query.ray.tfar};
}

float RayCaster::opacity(const Hit& hit) const {
    if (!(scene_.material_of(hit.triangle).flags & (material_alpha_mask | material_alpha_blend))) return 1;
    return surfaces_.opacity_at(hit.triangle, surfaces_.surface_at(hit.triangle, hit.barycentrics));
}

/// Nearest surface that counts. At a surface of alpha < 1, `number(hit)` in [0, 1) decides: it is met when the number
/// is below alpha.
template <class Choose>
std::optional<Hit> RayCaster::nearest_chosen(vec3 origin, vec3 direction, float max_distance, const Choose& number,
                                             std::vector<Hit>* passed_hits) const {
    std::optional<Hit> hit = nearest_triangle(origin, direction, max_distance);
    if (!has_holes_) return hit;
    float passed = 0;
    for (int layers = 0; hit && layers < max_layers; ++layers) {
        const float there = opacity(*hit);
        if (there >= 1 || (there > 0 && number(*hit) < there)) break;
        if (passed_hits && there > 0)
            passed_hits->push_back({hit->triangle, hit->barycentrics, passed + hit->distance});
        passed += hit->distance + epsilon_;
        hit = nearest_triangle(origin + direction * passed, direction, max_distance - passed);
    }
    if (hit) hit->distance += passed;
    return hit;
}

std::optional<Hit> RayCaster::nearest(vec3 origin, vec3 direction, float max_distance) const {
    return nearest_chosen(origin, direction, max_distance, [](const Hit& hit) {
        const vec2 b = hit.barycentrics;
        const uint64_t place = (uint64_t(floatBitsToUint(b.x)) << 32) | floatBitsToUint(b.y);
        return to_unit_float(uint32_t(mix64(place ^ hit.triangle) >> 32));
    });
}

std::optional<Hit> RayCaster::nearest(vec3 origin, vec3 direction, Rng& rng, std::vector<Hit>* passed) const {
    return nearest_chosen(
        origin, direction, 1e30f, [&](const Hit&) { return rng.next(); }, passed);
}

vec3 RayCaster::transmittance(vec3 from, vec3 to) const {
    const vec3 path = to - from;
    const float distance = length(path);
    if (!(distance > 0)) return vec3(1);
    const vec3 direction = path / distance;
    const float far = distance - epsilon_;
    if (far <= 0) return vec3(1);
    if (!has_holes_ && !has_thin_glass_) {
        RTCRay ray = make_ray(from, direction, far);
        return occluded(as_scene(embree_scene_), ray) ? vec3(0) : vec3(1);
    }
    vec3 passed_fraction(1);
    float passed = 0;
    for (int layers = 0; layers < max_layers; ++layers) {
        const std::optional<Hit> hit = nearest_triangle(from + direction * passed, direction, far - passed);
        if (!hit) return passed_fraction;
        passed_fraction *= surfaces_.passed_by(hit->triangle, hit->barycentrics, direction);
        if (std::max({passed_fraction.x, passed_fraction.y, passed_fraction.z}) <= 0) return vec3(0);
        passed += hit->distance + epsilon_;
        if (passed >= far) return passed_fraction;
    }
    return vec3(0);
}

bool RayCaster::triangles_around(vec3 point, float radius, size_t most, std::vector<uint>& found) const {
    found.clear();
    Collected collected{scene_, point, radius, most, found};
    RTCPointQuery query{};
    query.x = point.x, query.y = point.y, query.z = point.z;
    query.radius = radius;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(as_scene(embree_scene_), &query, &context, collect, &collected);
    return collected.complete;
}

}  // namespace lw
