// Storage and texel buffers in device memory, filled and read back through a small host-visible staging buffer.
#pragma once
#include <span>

#include "gpu/device.h"

namespace lw {

/// Owns a buffer and its memory. Device-local ones can be bound as storage or texel buffers and copied to and from.
class Buffer {
  public:
    /// device: memory of the device. host: visible to the CPU and coherent, for staging. traced: memory of the device
    /// for acceleration structures and their input; needs Device::ray_queries().
    enum class Place { device, host, traced };

    Buffer() = default;
    /// Throws Error naming `what` and its size when the device has not enough memory. bytes > 0.
    Buffer(const Device& device, vk::DeviceSize bytes, const std::string& what, Place place = Place::device);

    vk::Buffer handle() const { return *buffer_; }
    vk::DeviceSize size() const { return size_; }
    /// The address of a traced buffer.
    vk::DeviceAddress address(const Device& device) const { return device.handle().getBufferAddress(*buffer_); }
    /// The first byte of a host buffer; nullptr for others.
    void* mapped() const { return mapped_; }

  private:
    vk::DeviceSize size_ = 0;
    vk::UniqueDeviceMemory memory_;
    vk::UniqueBuffer buffer_;
    void* mapped_ = nullptr;
};

/// Copies `count` bytes to the start of a device buffer and waits until that is done.
void write_bytes(const Device& device, const Buffer& buffer, const void* bytes, size_t count);
/// Records a copy of bytes into a device buffer from its start, after all commands before and for all after. For a few
/// kilobytes: they travel inside the commands.
void record_bytes(vk::CommandBuffer commands, const Buffer& buffer, const void* bytes, size_t count);
template <class T>
void record_update(vk::CommandBuffer commands, const Buffer& buffer, std::span<const T> values) {
    record_bytes(commands, buffer, values.data(), values.size_bytes());
}
/// Copies `count` bytes from the start of a device buffer and waits until that is done.
void read_bytes(const Device& device, const Buffer& buffer, void* bytes, size_t count);

/// A view of the buffer as texels of this format, for texelFetch.
vk::UniqueBufferView view_as_texels(const Device& device, const Buffer& buffer, vk::Format format);

/// A device buffer with a copy of `values`; with 128 zero bytes when there are none, so that it can be bound. `what`
/// names it in errors.
template <class T>
Buffer upload(const Device& device, std::span<const T> values, const std::string& what,
              Buffer::Place place = Buffer::Place::device) {
    static const char nothing[128] = {};
    const size_t bytes = values.size_bytes();
    Buffer buffer(device, bytes ? bytes : sizeof nothing, what, place);
    write_bytes(device, buffer, bytes ? static_cast<const void*>(values.data()) : nothing,
                bytes ? bytes : sizeof nothing);
    return buffer;
}

/// The first `count` values of a device buffer.
template <class T>
std::vector<T> read_back(const Device& device, const Buffer& buffer, size_t count) {
    std::vector<T> values(count);
    read_bytes(device, buffer, values.data(), count * sizeof(T));
    return values;
}

}  // namespace lw
