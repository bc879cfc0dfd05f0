#include "trace/build_bvh.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <memory>

#include "base/error.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr unsigned max_in_leaf = 4;
constexpr uint see_through_flags = material_alpha_mask | material_alpha_blend | material_thin;

/// A node of Embree's builder before it is laid out depth first.
struct BuiltNode {
    std::array<RTCBounds, 2> bounds;
    std::array<BuiltNode*, 2> children;
    unsigned count;  // triangles of a leaf, 0 for an inner node
    std::array<uint, max_in_leaf> triangles;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode{};
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuiltNode*>(node)->children[i] = static_cast<BuiltNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<BuiltNode*>(node)->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode{};
    leaf->count = unsigned(count);
    for (size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
    std::sort(leaf->triangles.begin(), leaf->triangles.begin() + long(count));
    return leaf;
}

std::vector<RTCBuildPrimitive> primitives_of(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(scene.triangles.size());
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const auto [a, b, c] = triangle_corners(scene, t);
        if (!(length(edge_product(a, b, c)) > 0)) continue;
        const vec3 low = min(a, min(b, c)), high = max(a, max(b, c));
        const bool opaque = !(scene.material_of(uint(t)).flags & see_through_flags);
        const unsigned entry = unsigned(t) | (opaque ? 0 : bvh_see_through);
        primitives.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, entry});
    }
    return primitives;
}

/// Appends the subtree depth first; each node gets the index of the node to go to when its box is missed.
void lay_out(const BuiltNode& node, const RTCBounds& bounds, Bvh& bvh) {
    const size_t index = bvh.nodes.size();
    const uint leaf = node.count ? uint(bvh.triangles.size()) << 4 | node.count : 0;
    bvh.nodes.push_back(
        {{bounds.lower_x, bounds.lower_y, bounds.lower_z}, 0, {bounds.upper_x, bounds.upper_y, bounds.upper_z}, leaf});
    bvh.triangles.insert(bvh.triangles.end(), node.triangles.begin(), node.triangles.begin() + node.count);
    if (!node.count)
        for (size_t i = 0; i < 2; ++i) lay_out(*node.children[i], node.bounds[i], bvh);
    bvh.nodes[index].skip = uint(bvh.nodes.size());
}

RTCBounds bounds_of(const Scene& scene) {
    const vec3 low = scene.bounds[0], high = scene.bounds[1];
    return {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

struct Releases {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

}  // namespace

Bvh build_bvh(const Scene& scene) {
    Bvh result;
    std::vector<RTCBuildPrimitive> primitives = primitives_of(scene);
    if (scene.lights.empty() || primitives.empty()) return result;
    const std::unique_ptr<RTCDeviceTy, Releases> device(rtcNewDevice("threads=1"));
    if (!device) throw Error("Embree: no device could be created");
    const std::unique_ptr<RTCBVHTy, Releases> bvh(rtcNewBVH(device.get()));
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxLeafSize = max_in_leaf;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const auto* root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
    if (!root) throw Error(scene.path.filename().string() + ": not enough memory for the hierarchy of the shadow rays");
    lay_out(*root, bounds_of(scene), result);
    return result;
}

}  // namespace lw
