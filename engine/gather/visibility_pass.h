// Rasterises the scene: per pixel the triangle that is seen and where on it. Cut-outs and glass let the view through.
#pragma once
#include <array>

#include "gather/cull_pass.h"
#include "gpu/target.h"

namespace lw {

/// What one pixel sees, as the visibility texture holds it.
struct VisibleSample {
    uint triangle = no_triangle;
    vec2 barycentrics{0};  // weights of the second and third vertex
    float depth = 0;       // m along -Z
};
static_assert(sizeof(VisibleSample) == 16);

class VisibilityPass {
  public:
    /// `culled_from`: triangles of a scene from which on those without a pixel are left out.
    VisibilityPass(const Device& device, const Resident& resident, vk::Extent2D size, size_t culled_from = min_culled);
    /// Draws frame.width x frame.height pixels from the top left corner, at most the pass's size. Afterwards texture()
    /// is readable by compute shaders.
    void record(vk::CommandBuffer commands, const Frame& frame) const;
    const Target& texture() const { return visible_; }
    /// The samples of the last recorded and finished frame, row 0 on top.
    std::vector<VisibleSample> read_samples() const;

  private:
    void draw(vk::CommandBuffer commands, const Frame& frame) const;

    const Device* device_;
    const Resident* resident_;
    CullPass cull_;
    Target visible_;
    Target depth_;
    vk::UniquePipelineLayout layout_;
    std::array<vk::UniquePipeline, 2> pipelines_;  // of opaque clusters, and of those that discard pixels
};

}  // namespace lw
