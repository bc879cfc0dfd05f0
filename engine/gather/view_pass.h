// Turns pictures into the sRGB codes that a window shows (shaders/view.comp): exposed, in false colours, or A beside B.
// Copies a grid of their values to the CPU (the readback), which can be read once the frame's commands have finished.
#pragma once
#include <array>
#include <map>

#include "gather/picture.h"
#include "shaders/view.h"

namespace lw {

/// What the view pass is specialized for: one pipeline for each.
struct ViewKind {
    uint view = view_shaded;
    uint curve = curve_neutral;
    bool has_lines = false;
    bool has_split = false;  // B to the right of push.split
    auto operator<=>(const ViewKind&) const = default;
};

class ViewPass {
  public:
    static constexpr uint slots = 2;

    /// Reads a and b and what their pixels see, writes the screen of a. All must outlive it.
    ViewPass(const Device& device, const Target& visibility, const Picture& a, const Picture& b);
    void record(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot);
    /// readback_columns x readback_rows values of a slot whose commands have finished.
    std::vector<ReadbackPixel> readback(uint slot) const;

  private:
    vk::Pipeline pipeline_for(const ViewKind& kind, bool is_scaled, bool is_readback);

    const Device* device_;
    Buffer readback_;
    std::array<Buffer, slots> read_back_;
    DescriptorSet descriptors_;
    vk::UniquePipelineLayout layout_;
    std::map<std::tuple<ViewKind, bool, bool>, vk::UniquePipeline> pipelines_;  // is_scaled, is_readback
};

}  // namespace lw
