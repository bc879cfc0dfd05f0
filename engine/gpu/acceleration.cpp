#include "gpu/acceleration.h"

#include "gpu/commands.h"

namespace lw {
namespace {

using Type = vk::AccelerationStructureTypeKHR;
using Range = vk::AccelerationStructureBuildRangeInfoKHR;
using Geometry = vk::AccelerationStructureGeometryKHR;

vk::DeviceSize scratch_alignment(const Device& device) {
    const auto chain = device.physical()
                           .getProperties2<vk::PhysicalDeviceProperties2,
                                           vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    return std::max(1u, chain.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                            .minAccelerationStructureScratchOffsetAlignment);
}

}  // namespace

Acceleration::Acceleration(const Device& device, const TracedTriangles& triangles)
    : dispatch_(std::make_unique<vk::DispatchLoaderDynamic>(device.instance(), vkGetInstanceProcAddr, device.handle(),
                                                            vkGetDeviceProcAddr)) {
    const Buffer positions = upload(device, triangles.positions, "positions for rays", Buffer::Place::traced);
    const Buffer corners = upload(device, triangles.corners, "triangles for rays", Buffer::Place::traced);
    const vk::AccelerationStructureGeometryTrianglesDataKHR data(
        vk::Format::eR32G32B32Sfloat, positions.address(device), sizeof(glm::vec3),
        uint32_t(triangles.positions.size()) - 1, vk::IndexType::eUint32, corners.address(device));
    const auto of = [&](vk::GeometryFlagBitsKHR flag) { return Geometry(vk::GeometryTypeKHR::eTriangles, data, flag); };
    const Geometry geometries[] = {of(vk::GeometryFlagBitsKHR::eOpaque),
                                   of(vk::GeometryFlagBitsKHR::eNoDuplicateAnyHitInvocation)};
    const auto opaque = uint32_t(triangles.opaque), others = uint32_t(triangles.corners.size()) - opaque;
    const Range ranges[] = {Range(opaque), Range(others, uint32_t(sizeof(glm::uvec3)) * opaque)};
    const size_t count = others > 0 ? 2 : 1;
    triangles_ = build(device, Type::eBottomLevel, {geometries, count}, {ranges, count});

    const vk::TransformMatrixKHR identity(std::array<std::array<float, 4>, 3>{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
    const vk::AccelerationStructureInstanceKHR instance(
        identity, 0, 0xff, 0, vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable,
        device.handle().getAccelerationStructureAddressKHR(*triangles_.handle, *dispatch_));
    const Buffer instances = upload<vk::AccelerationStructureInstanceKHR>(device, {&instance, 1}, "instance for rays",
                                                                          Buffer::Place::traced);
    const Geometry one(vk::GeometryTypeKHR::eInstances,
                       vk::AccelerationStructureGeometryInstancesDataKHR(false, instances.address(device)));
    const Range range(1);
    scene_ = build(device, Type::eTopLevel, {&one, 1}, {&range, 1});
}

Acceleration::Level Acceleration::build(const Device& device, Type type, std::span<const Geometry> geometries,
                                        std::span<const Range> ranges) const {
    vk::AccelerationStructureBuildGeometryInfoKHR info(type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
                                                       vk::BuildAccelerationStructureModeKHR::eBuild);
    info.setGeometries(geometries);
    std::vector<uint32_t> counts;
    for (const Range& range : ranges) counts.push_back(range.primitiveCount);
    const auto sizes = device.handle().getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, info, counts, *dispatch_);
    Level level{Buffer(device, sizes.accelerationStructureSize, "rays", Buffer::Place::traced), {}};
    level.handle = device.handle().createAccelerationStructureKHRUnique(
        {{}, level.buffer.handle(), 0, sizes.accelerationStructureSize, type}, nullptr, *dispatch_);
    const vk::DeviceSize alignment = scratch_alignment(device);
    const Buffer scratch(device, sizes.buildScratchSize + alignment, "building what rays meet", Buffer::Place::traced);
    info.dstAccelerationStructure = *level.handle;
    info.scratchData = (scratch.address(device) + alignment - 1) / alignment * alignment;
    submit_and_wait(device, [&](vk::CommandBuffer commands) {
        commands.buildAccelerationStructuresKHR(info, ranges.data(), *dispatch_);
    });
    return level;
}

}  // namespace lw
