// Lists the triangles that may cover the centre of a pixel, in the scene's order, for the draw (docs/decisions/0013). A
// software rasterizer takes longer for a triangle without pixels than this compute pass. The picture is the same as
// with all triangles.
#pragma once
#include "gather/resident.h"
#include "shaders/cull.h"

namespace lw {

/// Scenes with fewer triangles are drawn without culling, which would take longer than it saves.
constexpr size_t min_culled = 4096;

class CullPass {
  public:
    /// `culled_from`: record() culls when the scene has at least so many triangles.
    CullPass(const Device& device, const Resident& resident, size_t culled_from = min_culled);
    /// Records the culling for a view. Afterwards vertex shaders may read descriptors(), and draw() may be recorded.
    void record(vk::CommandBuffer commands, const Frame& frame) const;
    /// Records the draw of the listed triangles of one kind of clusters, opaque or see-through. The bound pipeline must
    /// have first_listed() as its constant first_listed.
    void draw(vk::CommandBuffer commands, bool see_through) const;
    uint first_listed(bool see_through) const { return see_through ? first_see_through_ : 0; }
    const DescriptorSet& descriptors() const { return descriptors_; }
    /// The arguments of the two draws of the last finished frame: of opaque and of see-through clusters.
    std::vector<DrawArguments> read_draws() const { return read_back<DrawArguments>(*device_, draws_, 2); }

  private:
    void make_pipelines();

    const Device* device_;
    const Resident* resident_;
    bool culls_;
    uint blocks_ = 0;
    uint first_see_through_ = 0;
    Buffer clusters_, survivors_, draws_, listed_;
    vk::UniqueBufferView cluster_texels_, listed_texels_;
    DescriptorSet descriptors_;
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline cull_, scan_, compact_;
};

}  // namespace lw
