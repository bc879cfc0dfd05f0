// The gather: computes radiance and illuminance at the surface that each pixel shows, from the photon map and rays.
#pragma once
#include <array>

#include "gather/picture.h"
#include "gather/resident.h"
#include "maps/gather_settings.h"

namespace lw {

/// The specialization constants of a gather of this resident scene with these settings.
FrameConstants constants_for(const Resident& resident, const GatherSettings& settings);

/// The push constants of a view, completed with the members that follow from the scene, the lamps at setting `lamps`,
/// and the gather settings.
Frame with_gather(Frame frame, const Resident& resident, const GatherSettings& settings, uint lamps = 0);

/// The rows [first, end) of a picture. Both are multiples of gather_group_side, except for the end of the picture.
struct Rows {
    uint first = 0, end = ~0u;
};

class GatherPass {
  public:
    /// Throws Error when the exact mode is asked for more than max_exact_neighbours.
    GatherPass(const Device& device, const Resident& resident, const Picture& picture, GatherSettings settings);
    /// Records the gather: reads the visibility texture and writes the picture, which may be read after a barrier.
    void record(vk::CommandBuffer commands, const Frame& frame) const { record(commands, frame, *picture_); }
    /// The same into some rows of another picture with the same visibility texture. `lamps`: the setting of
    /// Resident::set_light_factors().
    void record(vk::CommandBuffer commands, const Frame& frame, const Picture& picture, uint lamps = 0,
                Rows rows = {}) const;

  private:
    void empty_lists(vk::CommandBuffer commands, const Picture& picture, uint lists) const;
    void size_lists(vk::CommandBuffer commands) const;
    void record_rays(vk::CommandBuffer commands, const Picture& picture, vk::Pipeline rays) const;
    void record_path(vk::CommandBuffer commands, const Picture& picture, const Following& following) const;
    void dispatch_list(vk::CommandBuffer commands, const Picture& picture, uint list) const;

    const Resident* resident_;
    const Picture* picture_;
    uint ray_pairs_;
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline photons_, rays_;                             // rays_ only where the scene has lamps
    vk::UniquePipeline sizes_;                                      // only where pixels are listed
    vk::UniquePipeline follow_, followed_photons_, followed_rays_;  // only where view paths go on
    std::array<bool, branch_count> has_branch_{};
    uint lobes_ = 0;  // most lobes that are followed one after another
};

}  // namespace lw
