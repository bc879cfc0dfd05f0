// Light at what each pixel sees, from the photon map: radiance and illuminance.
#pragma once
#include <array>

#include "gather/picture.h"
#include "gather/resident.h"
#include "maps/gather_settings.h"

namespace lw {

/// What the pipelines of a gather are compiled with: what the scene and the settings need.
FrameConstants constants_for(const Resident& resident, const GatherSettings& settings);

/// The push constants of a view with what its passes need of the scene, its lamps at a setting, and the settings.
Frame with_gather(Frame frame, const Resident& resident, const GatherSettings& settings, uint lamps = 0);

/// Rows of a picture: [first, end), both multiples of gather_group_side but for the end of the picture.
struct Rows {
    uint first = 0, end = ~0u;
};

class GatherPass {
  public:
    /// Throws Error when the exact mode is asked for more than max_exact_neighbours.
    GatherPass(const Device& device, const Resident& resident, const Picture& picture, GatherSettings settings);
    /// Reads the visibility texture, writes the picture; for compute shaders and copies after a barrier.
    void record(vk::CommandBuffer commands, const Frame& frame) const { record(commands, frame, *picture_); }
    /// The same into some rows of another picture of the same visibility texture, with the lamps at one of their
    /// settings.
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
    vk::UniquePipeline photons_, rays_;                             // the latter where the scene has lamps
    vk::UniquePipeline sizes_;                                      // where pixels are listed
    vk::UniquePipeline follow_, followed_photons_, followed_rays_;  // where view paths go on
    std::array<bool, branch_count> has_branch_{};
    uint lobes_ = 0;  // one after another
};

}  // namespace lw
