// Tone mapping: turns the radiance of a picture into sRGB codes for a screen (shaders/tonemap.glsl).
#pragma once
#include "gather/picture.h"

namespace lw {

class TonemapPass {
  public:
    TonemapPass(const Device& device, const Resident& resident, const Picture& picture);
    void record(vk::CommandBuffer commands, const Screen& screen) const;

  private:
    const Picture* picture_;
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline pipeline_;
};

}  // namespace lw
