// The picture being made, in GPU memory, as descriptor set 1 of gather and tone mapping (shaders/frame.h).
#pragma once
#include "gather/visibility_pass.h"

namespace lw {

class Picture {
  public:
    /// Throws Error when a plane of this size is beyond the device's buffers.
    Picture(const Device& device, const Target& visibility);
    const DescriptorSet& descriptors() const { return descriptors_; }
    const Buffer& radiance() const { return radiance_; }          // vec4: RGB cd/m2, illuminance lx
    const Buffer& normal_depth() const { return normal_depth_; }  // vec4: shading normal, depth m
    const Buffer& screen() const { return screen_; }              // RGBA8

  private:
    Buffer radiance_, normal_depth_, screen_;
    DescriptorSet descriptors_;
};

}  // namespace lw
