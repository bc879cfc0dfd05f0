#include "gpu/buffer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "base/error.h"
#include "gpu/commands.h"

namespace lw {
namespace {

constexpr size_t staging_bytes = size_t(32) << 20;

vk::UniqueDeviceMemory allocate(const Device& device, vk::MemoryRequirements needs, Buffer::Place place) {
    using Property = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags host = Property::eHostVisible | Property::eHostCoherent;
    const vk::MemoryPropertyFlags wanted = place == Buffer::Place::host ? host : Property::eDeviceLocal;
    int type =
        place == Buffer::Place::host ? device.find_memory_type(needs.memoryTypeBits, host | Property::eHostCached) : -1;
    if (type < 0) type = device.find_memory_type(needs.memoryTypeBits, wanted);
    if (type < 0) throw Error(device.name() + ": has no suitable memory");
    const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
    const void* next = place == Buffer::Place::traced ? &addressed : nullptr;
    return device.handle().allocateMemoryUnique({needs.size, uint32_t(type), next});
}

vk::BufferUsageFlags usage_of(Buffer::Place place) {
    const auto copies = vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;
    if (place == Buffer::Place::host) return copies;
    const auto read = copies | vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformTexelBuffer |
                      vk::BufferUsageFlagBits::eIndirectBuffer;
    if (place == Buffer::Place::device) return read;
    return read | vk::BufferUsageFlagBits::eShaderDeviceAddress |
           vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR |
           vk::BufferUsageFlagBits::eAccelerationStructureStorageKHR;
}

}  // namespace

Buffer::Buffer(const Device& device, vk::DeviceSize bytes, const std::string& what, Place place) : size_(bytes) {
    assert(bytes > 0);
    try {
        buffer_ = device.handle().createBufferUnique({{}, bytes, usage_of(place)});
        memory_ = allocate(device, device.handle().getBufferMemoryRequirements(*buffer_), place);
        device.handle().bindBufferMemory(*buffer_, *memory_, 0);
        if (place == Place::host) mapped_ = device.handle().mapMemory(*memory_, 0, VK_WHOLE_SIZE);
    } catch (const vk::SystemError& failure) {
        throw Error(device.name() + ": no memory for " + what + ", " + std::to_string((bytes >> 20) + 1) + " MiB of " +
                    std::to_string(device.memory_budget() >> 20) + " MiB that may be used: " + failure.what());
    }
}

vk::UniqueBufferView view_as_texels(const Device& device, const Buffer& buffer, vk::Format format) {
    return device.handle().createBufferViewUnique({{}, buffer.handle(), format, 0, VK_WHOLE_SIZE});
}

void write_bytes(const Device& device, const Buffer& buffer, const void* bytes, size_t count) {
    assert(count <= buffer.size());
    if (count == 0) return;
    const Buffer staging(device, std::min(count, staging_bytes), "staging", Buffer::Place::host);
    for (size_t done = 0; done < count; done += staging_bytes) {
        const size_t part = std::min(count - done, staging_bytes);
        std::memcpy(staging.mapped(), static_cast<const char*>(bytes) + done, part);
        submit_and_wait(device, [&](vk::CommandBuffer commands) {
            stage_barrier(commands, vk::PipelineStageFlagBits2::eAllCommands,
                          vk::PipelineStageFlagBits2::eTransfer);  // frames in flight may still read the buffer
            commands.copyBuffer(staging.handle(), buffer.handle(), vk::BufferCopy(0, done, part));
            stage_barrier(commands, vk::PipelineStageFlagBits2::eTransfer, vk::PipelineStageFlagBits2::eAllCommands);
        });
    }
}

void record_bytes(vk::CommandBuffer commands, const Buffer& buffer, const void* bytes, size_t count) {
    constexpr size_t max_update = 65536;  // of vkCmdUpdateBuffer
    using Stage = vk::PipelineStageFlagBits2;
    stage_barrier(commands, Stage::eAllCommands, Stage::eTransfer);
    for (size_t done = 0; done < count; done += max_update)
        commands.updateBuffer(buffer.handle(), done, std::min(count - done, max_update),
                              static_cast<const char*>(bytes) + done);
    stage_barrier(commands, Stage::eTransfer, Stage::eAllCommands);
}

void read_bytes(const Device& device, const Buffer& buffer, void* bytes, size_t count) {
    assert(count <= buffer.size());
    if (count == 0) return;
    const Buffer staging(device, std::min(count, staging_bytes), "staging", Buffer::Place::host);
    for (size_t done = 0; done < count; done += staging_bytes) {
        const size_t part = std::min(count - done, staging_bytes);
        submit_and_wait(device, [&](vk::CommandBuffer commands) {
            stage_barrier(commands, vk::PipelineStageFlagBits2::eAllCommands, vk::PipelineStageFlagBits2::eTransfer);
            commands.copyBuffer(buffer.handle(), staging.handle(), vk::BufferCopy(done, 0, part));
            stage_barrier(commands, vk::PipelineStageFlagBits2::eTransfer, vk::PipelineStageFlagBits2::eHost);
        });
        std::memcpy(static_cast<char*>(bytes) + done, staging.mapped(), part);
    }
}

}  // namespace lw
