// Pictures to what is looked at (shaders/view.comp): exposed, in false colours, A beside B; and the glance, a few of
// their values, back on the CPU a frame late.
#pragma once
#include <array>

#include "gather/picture.h"
#include "shaders/view.h"

namespace lw {

class ViewPass {
  public:
    static constexpr uint slots = 2;

    /// Reads a and b, writes the screen of a. The pictures must outlive it.
    ViewPass(const Device& device, const Picture& a, const Picture& b);
    void record(vk::CommandBuffer commands, const ViewPush& push, uint slot) const;
    /// glance_columns x glance_rows values of a slot whose commands have finished.
    std::vector<Glance> glance(uint slot) const;

  private:
    Buffer glance_;
    std::array<Buffer, slots> read_back_;
    DescriptorSet descriptors_;
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline pipeline_;
};

}  // namespace lw
