#include "gather/picture.h"

#include "base/error.h"
#include "gather/bindings.h"

namespace lw {
namespace {

Buffer plane(const Device& device, vk::Extent2D size, size_t pixel_bytes, const std::string& what) {
    const uint64_t bytes = uint64_t(size.width) * size.height * pixel_bytes;
    if (bytes > device.limits().maxStorageBufferRange)
        throw Error(device.name() + ": a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                    " is too large, at most " + std::to_string(device.limits().maxStorageBufferRange / pixel_bytes) +
                    " pixels");
    return Buffer(device, bytes, what);
}

uint lists_of(const Resident& resident) {
    return pixel_lists(uint(resident.scene().lights.size()), resident.may_follow());
}

}  // namespace

Picture::Picture(const Device& device, const Target& visibility, const Resident& resident)
    : radiance_(plane(device, visibility.size(), 16, "radiance")),
      ray_lists_(device, lists_of(resident) * sizeof(RayPixels), "lists of pixels"),
      ray_pixels_(plane(device, visibility.size(), lists_of(resident) * sizeof(uint), "listed pixels")),
      screen_(plane(device, visibility.size(), 4, "screen")),
      followed_(plane(device, resident.may_follow() ? visibility.size() : vk::Extent2D{1, 1}, sizeof(Followed),
                      "ends of followed paths")),
      descriptors_(device, bindings_of(BindingSet::picture)) {
    descriptors_.set_target(binding_visibility, visibility);
    descriptors_.set_buffer(binding_radiance, radiance_);
    descriptors_.set_buffer(binding_ray_lists, ray_lists_);
    descriptors_.set_buffer(binding_ray_pixels, ray_pixels_);
    descriptors_.set_buffer(binding_screen, screen_);
    descriptors_.set_buffer(binding_followed, followed_);
    light_ = view_as_texels(device, radiance_, vk::Format::eR32G32B32A32Sfloat);
    descriptors_.set_texels(binding_light, *light_);
}

}  // namespace lw
