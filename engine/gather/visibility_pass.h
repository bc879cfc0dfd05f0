// Rasterises the scene: for each pixel the triangle it shows and the point on it. Holes of alpha masks let the view
// through, and so do glass and blends when no rays follow what is behind them.
#pragma once
#include <array>

#include "gather/cull_pass.h"
#include "gpu/target.h"

namespace lw {

/// What one pixel shows, as stored in the visibility texture.
struct VisibleSample {
    uint triangle = no_triangle;
    vec2 barycentrics{0};  // weights of the second and third vertex
    float depth = 0;       // m along -Z
};
static_assert(sizeof(VisibleSample) == 16);

class VisibilityPass {
  public:
    /// `culled_from`: triangles without a pixel are left out when the scene has at least so many triangles.
    VisibilityPass(const Device& device, const Resident& resident, vk::Extent2D size, size_t culled_from = min_culled);
    /// Records the draw of frame.width x frame.height pixels, from the top left corner and at most as many as the pass
    /// has. Afterwards compute shaders may read texture().
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
    std::array<vk::UniquePipeline, 2> pipelines_;  // for opaque clusters, and for those that discard pixels
};

}  // namespace lw
