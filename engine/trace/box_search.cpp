#include "trace/box_search.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "base/error.h"

namespace lw {
namespace {

struct PointVisit {
    void (*visit)(void*, uint);
    void* context;
};

bool on_point_query(RTCPointQueryFunctionArguments* arguments) {
    const auto* target = static_cast<const PointVisit*>(arguments->userPtr);
    target->visit(target->context, arguments->primID);
    return false;  // the radius stays
}

void box_bounds(const RTCBoundsFunctionArguments* arguments) {
    const Box& box = static_cast<const Box*>(arguments->geometryUserPtr)[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.low.x, bounds.lower_y = box.low.y, bounds.lower_z = box.low.z;
    bounds.upper_x = box.high.x, bounds.upper_y = box.high.y, bounds.upper_z = box.high.z;
}

}  // namespace

BoxSearch::BoxSearch(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    RTCDevice device = rtcNewDevice(nullptr);
    if (!device) throw Error("Embree: no device could be created");
    device_ = device;
    RTCScene scene = rtcNewScene(device);
    scene_ = scene;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(boxes_.size()));
    rtcSetGeometryUserData(geometry, boxes_.data());
    rtcSetGeometryBoundsFunction(geometry, box_bounds, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        throw Error("photon map: Embree could not build the hierarchy of the maps");
}

BoxSearch::~BoxSearch() {
    if (scene_) rtcReleaseScene(static_cast<RTCScene>(scene_));
    if (device_) rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

void BoxSearch::query(vec3 point, float radius, void (*visit)(void*, uint), void* context) const {
    RTCPointQuery query{};
    query.x = point.x, query.y = point.y, query.z = point.z;
    query.radius = radius;
    RTCPointQueryContext query_context;
    rtcInitPointQueryContext(&query_context);
    PointVisit target{visit, context};
    rtcPointQuery(static_cast<RTCScene>(scene_), &query, &query_context, on_point_query, &target);
}

}  // namespace lw
