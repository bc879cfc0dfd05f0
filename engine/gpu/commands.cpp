#include "gpu/commands.h"

#include "base/error.h"

namespace lw {

void submit_and_wait(const Device& device, const std::function<void(vk::CommandBuffer)>& record) try {
    const vk::Device d = device.handle();
    auto buffers = d.allocateCommandBuffersUnique({device.command_pool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::CommandBuffer commands = *buffers[0];
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    const vk::UniqueFence fence = d.createFenceUnique({});
    const vk::CommandBufferSubmitInfo buffer_info(commands);
    device.queue().submit2(vk::SubmitInfo2({}, {}, buffer_info, {}), *fence);
    if (d.waitForFences(*fence, true, UINT64_MAX) != vk::Result::eSuccess)
        throw Error(device.name() + ": does not finish its work");
} catch (const vk::DeviceLostError&) {
    throw DeviceLost(device.name() +
                     ": the device was lost (a driver's time limit, or it was unplugged); try fewer --samples "
                     "or a smaller picture");
} catch (const vk::SystemError& failure) {
    throw Error(device.name() + ": cannot do its work: " + failure.what());
}

void stage_barrier(vk::CommandBuffer commands, vk::PipelineStageFlags2 from, vk::PipelineStageFlags2 to) {
    const vk::MemoryBarrier2 barrier(from, vk::AccessFlagBits2::eMemoryWrite, to,
                                     vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite);
    commands.pipelineBarrier2(vk::DependencyInfo({}, barrier));
}

Timestamps::Timestamps(const Device& device, uint32_t count)
    : device_(&device),
      count_(count),
      pool_(device.handle().createQueryPoolUnique({{}, vk::QueryType::eTimestamp, count})) {}

std::vector<double> Timestamps::intervals_ms() const {
    const auto results =
        device_->handle().getQueryPoolResults<uint64_t>(*pool_, 0, count_, count_ * sizeof(uint64_t), sizeof(uint64_t),
                                                        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    const std::vector<uint64_t>& ticks = results.value;
    std::vector<double> intervals;
    for (size_t i = 1; i < ticks.size(); ++i)
        intervals.push_back(double(ticks[i] - ticks[i - 1]) * double(device_->limits().timestampPeriod) * 1e-6);
    return intervals;
}

}  // namespace lw
