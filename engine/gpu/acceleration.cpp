#include "gpu/acceleration.h"

#include <algorithm>

#include "gpu/commands.h"

namespace lw {
namespace {

using Type = vk::AccelerationStructureTypeKHR;
using Range = vk::AccelerationStructureBuildRangeInfoKHR;
using Geometry = vk::AccelerationStructureGeometryKHR;
using Stage = vk::PipelineStageFlagBits2;

vk::PhysicalDeviceAccelerationStructurePropertiesKHR limits_of(const Device& device) {
    using Limits = vk::PhysicalDeviceAccelerationStructurePropertiesKHR;
    return device.physical().getProperties2<vk::PhysicalDeviceProperties2, Limits>().get<Limits>();
}

void check_count(const Device& device, size_t triangles) {
    const uint64_t most = std::min<uint64_t>(limits_of(device).maxPrimitiveCount, UINT32_MAX);
    if (triangles > most)
        throw Error(device.name() + ": ray queries among " + std::to_string(triangles) + " triangles, at most " +
                    std::to_string(most) + "; use --rays compute");
}

}  // namespace

Acceleration::Acceleration(const Device& device, const TracedTriangles& triangles) {
    check_count(device, triangles.corners.size());
    const Buffer positions = upload(device, triangles.positions, "positions for rays", Buffer::Place::traced);
    const Buffer corners = upload(device, triangles.corners, "triangles for rays", Buffer::Place::traced);
    const auto geometry_from = [&](size_t first, vk::GeometryFlagBitsKHR flag) {
        const vk::AccelerationStructureGeometryTrianglesDataKHR data(
            vk::Format::eR32G32B32Sfloat, positions.address(device), sizeof(glm::vec3),
            uint32_t(triangles.positions.size()) - 1, vk::IndexType::eUint32,
            corners.address(device) + first * sizeof(glm::uvec3));
        return Geometry(vk::GeometryTypeKHR::eTriangles, data, flag);
    };
    const size_t opaque = triangles.opaque, others = triangles.corners.size() - opaque;
    const Geometry geometries[] = {geometry_from(0, vk::GeometryFlagBitsKHR::eOpaque),
                                   geometry_from(opaque, vk::GeometryFlagBitsKHR::eNoDuplicateAnyHitInvocation)};
    const Range ranges[] = {Range(uint32_t(opaque)), Range(uint32_t(others))};
    const size_t count = others > 0 ? 2 : 1;
    triangles_ = build(device, Type::eBottomLevel, {geometries, count}, {ranges, count});

    const vk::TransformMatrixKHR identity(
        std::array<std::array<float, 4>, 3>{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
    const vk::AccelerationStructureInstanceKHR instance(
        identity, 0, 0xff, 0, vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable,
        device.handle().getAccelerationStructureAddressKHR(*triangles_.handle, device.ray_functions()));
    const Buffer instances = upload<vk::AccelerationStructureInstanceKHR>(device, {&instance, 1}, "instance for rays",
                                                                          Buffer::Place::traced);
    const Geometry one(vk::GeometryTypeKHR::eInstances,
                       vk::AccelerationStructureGeometryInstancesDataKHR(false, instances.address(device)));
    const Range range(1);
    scene_ = build(device, Type::eTopLevel, {&one, 1}, {&range, 1});
}

Acceleration::Level Acceleration::build(const Device& device, Type type, std::span<const Geometry> geometries,
                                        std::span<const Range> ranges) const try {
    vk::AccelerationStructureBuildGeometryInfoKHR info(type,
                                                       vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
                                                       vk::BuildAccelerationStructureModeKHR::eBuild);
    info.setGeometries(geometries);
    std::vector<uint32_t> counts;
    for (const Range& range : ranges) counts.push_back(range.primitiveCount);
    const auto sizes = device.handle().getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, info, counts, device.ray_functions());
    Level level{Buffer(device, sizes.accelerationStructureSize, "rays", Buffer::Place::traced), {}};
    level.handle = device.handle().createAccelerationStructureKHRUnique(
        {{}, level.buffer.handle(), 0, sizes.accelerationStructureSize, type}, nullptr, device.ray_functions());
    const vk::DeviceSize alignment = std::max(1u, limits_of(device).minAccelerationStructureScratchOffsetAlignment);
    const Buffer scratch(device, sizes.buildScratchSize + alignment, "building what rays meet", Buffer::Place::traced);
    info.dstAccelerationStructure = *level.handle;
    info.scratchData = (scratch.address(device) + alignment - 1) / alignment * alignment;
    submit_and_wait(device, [&](vk::CommandBuffer commands) {
        commands.buildAccelerationStructuresKHR(info, ranges.data(), device.ray_functions());
        stage_barrier(commands, Stage::eAccelerationStructureBuildKHR, Stage::eAllCommands);
    });
    return level;
} catch (const vk::SystemError& failure) {
    throw Error(device.name() + ": cannot make what rays meet: " + failure.what());
}

}  // namespace lw
