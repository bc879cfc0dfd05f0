// Turns pictures into what the window shows (shaders/view.comp): exposed, in false colours, A beside B. Also copies a
// coarse grid of their values, which the CPU reads a frame later: the readback.
#pragma once
#include <array>
#include <map>

#include "gather/picture.h"
#include "shaders/view.h"

namespace lw {

/// The settings of the view pass that need a pipeline of their own.
struct ViewKind {
    uint view = view_shaded;
    uint curve = curve_neutral;
    bool has_lines = false;
    bool has_split = false;  // B is shown right of push.split
    auto operator<=>(const ViewKind&) const = default;
};

class ViewPass {
  public:
    static constexpr uint slots = 2;

    /// Reads pictures a and b and their visibility, writes the screen buffer of a. All must outlive it.
    ViewPass(const Device& device, const Target& visibility, const Picture& a, const Picture& b);
    void record(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot);
    /// The readback of a slot: readback_columns x readback_rows values, row by row. The slot's commands must have
    /// finished.
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
