// A view rendered frame after frame without waiting: passes are recorded into the caller's commands, and pictures stay
// on the device. There are two pictures with the same visibility: A, and B for a comparison or for values of an
// inspecting view. Samples add up while the view is still.
#pragma once
#include <map>
#include <memory>

#include "gather/gather_pass.h"
#include "gather/view_pass.h"
#include "gather/visibility_pass.h"
#include "gpu/commands.h"
#include "image/image.h"

namespace lw {

class FrameRenderer {
  public:
    enum class Side { a, b };

    /// Device and resident scene must outlive it. Throws Error when the size is beyond the device.
    FrameRenderer(const Device& device, const Resident& resident, vk::Extent2D size);

    vk::Extent2D size() const { return size_; }
    /// Records the visibility pass. `frame` may have fewer pixels than size().
    void record_visibility(vk::CommandBuffer commands, const Frame& frame) const;
    /// Records the gather of one sample into a picture. Sample 0 (frame.sample_index) overwrites the picture, later
    /// ones are added; for a running sum every frame has sample_weight 1. Sample 0, the only one in motion, follows
    /// mirrors and glass alone; sample 1 follows all lobes and takes its place in the sum. `lamps`: the setting of
    /// Resident::set_lamp_factors(). Throws Error when the exact mode is asked for too many neighbours.
    void record_light(vk::CommandBuffer commands, const Frame& frame, const GatherSettings& settings, Side side,
                      uint lamps = 0, Rows rows = {});
    /// Records the view pass: writes screen(), which may be copied afterwards, and the readback of frame slot 0 or 1.
    void record_view(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot);
    /// sRGB codes of the last view, 4 bytes a pixel.
    const Buffer& screen() const { return a_.screen(); }
    /// The readback that record_view() wrote into a slot; its commands must have finished.
    std::vector<ReadbackPixel> readback(uint slot) const { return view_.readback(slot); }
    /// Picture A as an image with the channels of Rendering::image, divided by the number of samples: `samples`, and
    /// one more in the first `fresh_rows` rows. Waits for the device.
    Image read_values(const Camera& camera, vk::Extent2D picture_size, uint samples, uint fresh_rows = 0) const;

  private:
    GatherPass& pass_for(const GatherSettings& settings);

    const Device* device_;
    const Resident* resident_;
    vk::Extent2D size_;
    VisibilityPass visibility_;
    Picture a_, b_;
    ViewPass view_;
    std::map<GatherSettings, std::unique_ptr<GatherPass>> passes_;  // of pipeline_settings()
};

}  // namespace lw
