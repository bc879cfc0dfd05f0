#include "gather/picture.h"

#include <array>

#include "base/error.h"

namespace lw {
namespace {

std::array<Binding, 4> picture_bindings() {
    return {Binding{binding_visibility, vk::DescriptorType::eSampledImage}, Binding{binding_radiance},
            Binding{binding_normal_depth}, Binding{binding_screen}};
}

Buffer plane(const Device& device, vk::Extent2D size, size_t pixel_bytes, const std::string& what) {
    const uint64_t bytes = uint64_t(size.width) * size.height * pixel_bytes;
    if (bytes > device.limits().maxStorageBufferRange)
        throw Error(device.name() + ": a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                    " is too large, at most " + std::to_string(device.limits().maxStorageBufferRange / pixel_bytes) +
                    " pixels");
    return Buffer(device, bytes, what);
}

}  // namespace

Picture::Picture(const Device& device, const Target& visibility)
    : radiance_(plane(device, visibility.size(), 16, "radiance")),
      normal_depth_(plane(device, visibility.size(), 16, "normals")),
      screen_(plane(device, visibility.size(), 4, "screen")),
      descriptors_(device, picture_bindings()) {
    descriptors_.set_target(binding_visibility, visibility);
    descriptors_.set_buffer(binding_radiance, radiance_);
    descriptors_.set_buffer(binding_normal_depth, normal_depth_);
    descriptors_.set_buffer(binding_screen, screen_);
}

}  // namespace lw
