// The buffers of a picture in GPU memory, as descriptor set 1 of gather and tone mapping (shaders/binding_table.h).
#pragma once
#include "gather/resident.h"
#include "gather/visibility_pass.h"

namespace lw {

class Picture {
  public:
    /// Makes the buffers for a picture as large as `visibility`: light, lists of pixels and, when view paths may go on
    /// in the resident scene, the ends of paths. Throws Error when one is too large for the device.
    Picture(const Device& device, const Target& visibility, const Resident& resident);
    const DescriptorSet& descriptors() const { return descriptors_; }
    const Buffer& radiance() const { return radiance_; }    // vec4: RGB cd/m2, illuminance lx
    vk::BufferView light() const { return *light_; }        // the same as texels
    const Buffer& ray_lists() const { return ray_lists_; }  // RayPixels per list
    const Buffer& screen() const { return screen_; }        // RGBA8

  private:
    Buffer radiance_, ray_lists_, ray_pixels_, screen_, followed_;
    vk::UniqueBufferView light_;
    DescriptorSet descriptors_;
};

}  // namespace lw
