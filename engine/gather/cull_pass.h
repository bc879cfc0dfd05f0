// Lists the triangles that may cover the centre of a pixel, in the scene's order, for the draw (decision 0013): a
// rasterizer on the CPU takes longer over a triangle without pixels than a compute shader. The picture is that of all
// triangles.
#pragma once
#include "gather/resident.h"
#include "shaders/cull.h"

namespace lw {

/// Scenes of fewer triangles are drawn whole: the dispatches take longer than their triangles.
constexpr size_t min_culled = 4096;

class CullPass {
  public:
    /// `culled_from`: triangles of a scene from which on record() culls.
    CullPass(const Device& device, const Resident& resident, size_t culled_from = min_culled);
    /// Makes the list of a view. Afterwards descriptors() may be read by vertex shaders, and draw() be recorded.
    void record(vk::CommandBuffer commands, const Frame& frame) const;
    /// Draws what is listed of one kind of clusters, by a pipeline whose constant_first_listed is first_listed().
    void draw(vk::CommandBuffer commands, bool see_through) const;
    uint first_listed(bool see_through) const { return see_through ? first_see_through_ : 0; }
    const DescriptorSet& descriptors() const { return descriptors_; }
    /// The draws of the last recorded and finished frame, of opaque clusters and of the others.
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
