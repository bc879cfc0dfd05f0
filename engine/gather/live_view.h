// A view that is made frame after frame without waiting: passes are recorded into the caller's commands, the picture
// stays on the device. Two pictures of one visibility: A, and B or what the estimates stand on. Samples add up while
// the view is still.
#pragma once
#include <map>
#include <memory>

#include "gather/gather_pass.h"
#include "gather/view_pass.h"
#include "gather/visibility_pass.h"
#include "gpu/commands.h"
#include "image/image.h"

namespace lw {

class LiveView {
  public:
    enum class Side { a, b };

    /// Device and resident scene must outlive it. Throws Error when the size is beyond the device.
    LiveView(const Device& device, const Resident& resident, vk::Extent2D size);

    vk::Extent2D size() const { return size_; }
    /// Records what each pixel sees. `frame` may have fewer pixels than size().
    void record_visibility(vk::CommandBuffer commands, const Frame& frame) const;
    /// Records the light of one sample into a picture: frame.sample_index 0 overwrites, others are added. For a running
    /// sum give every frame the sample_weight 1. Sample 0, all there is in motion, follows the lobes of mirrors alone;
    /// sample 1 follows all and replaces it in the sum. `lamps`: setting of Resident::set_lamp_factors(). Throws Error
    /// for too many neighbours of the exact mode.
    void record_light(vk::CommandBuffer commands, const Frame& frame, const GatherSettings& settings, Side side,
                      uint lamps = 0, Rows rows = {});
    /// Records the screen picture, and the readback of frame slot 0 or 1. Afterwards screen() may be copied.
    void record_view(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot);
    /// sRGB codes of the last view, 4 bytes a pixel.
    const Buffer& screen() const { return a_.screen(); }
    /// What record_view() wrote into a slot; its commands must have finished.
    std::vector<ReadbackPixel> readback(uint slot) const { return view_.readback(slot); }
    /// The channels of Rendering::image of picture A, seen by `camera`, divided by the `samples` in it, one more in its
    /// first `fresh_rows`; waits for the device.
    Image read_values(const Camera& camera, vk::Extent2D picture_size, uint samples, uint fresh_rows = 0) const;

  private:
    GatherPass& pass_for(const GatherSettings& settings);

    const Device* device_;
    const Resident* resident_;
    vk::Extent2D size_;
    VisibilityPass visibility_;
    Picture a_, b_;
    ViewPass view_;
    std::map<std::array<uint, 4>, std::unique_ptr<GatherPass>> passes_;  // by pipeline_key()
};

}  // namespace lw
