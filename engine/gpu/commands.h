// Recording, submitting and timing GPU work.
#pragma once
#include <functional>

#include "base/error.h"
#include "gpu/device.h"

namespace lw {

/// The device was lost. Everything on it is gone and must be made again on a new Device.
class DeviceLost : public Error {
  public:
    using Error::Error;
};

/// Records commands with `record`, submits them and waits until they are done. Throws DeviceLost.
void submit_and_wait(const Device& device, const std::function<void(vk::CommandBuffer)>& record);

/// Records a barrier: what earlier commands wrote in stage `from` is visible to later ones in stage `to`.
void stage_barrier(vk::CommandBuffer commands, vk::PipelineStageFlags2 from, vk::PipelineStageFlags2 to);

/// A set of `count` timestamps on the clock of the GPU.
class Timestamps {
  public:
    Timestamps(const Device& device, uint32_t count);
    /// Must be recorded before the first write, outside rendering.
    void reset(vk::CommandBuffer commands) const { commands.resetQueryPool(*pool_, 0, count_); }
    /// Writes, as timestamp `index`, the time when all earlier commands are done.
    void write(vk::CommandBuffer commands, uint32_t index) const {
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, index);
    }
    /// Milliseconds between neighbouring timestamps, count - 1 of them; the commands must have finished.
    std::vector<double> intervals_ms() const;

  private:
    const Device* device_;
    uint32_t count_;
    vk::UniqueQueryPool pool_;
};

}  // namespace lw
