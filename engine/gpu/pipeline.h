// Pipelines and the descriptor sets they read.
#pragma once
#include <span>

#include "gpu/buffer.h"
#include "gpu/specialize.h"
#include "gpu/target.h"

namespace lw {

/// One binding of a descriptor set: number, type, count of the array, stages that read it.
struct Binding {
    uint32_t binding;
    vk::DescriptorType type = vk::DescriptorType::eStorageBuffer;
    uint32_t count = 1;
    vk::ShaderStageFlags stages = vk::ShaderStageFlagBits::eCompute;
};

/// One descriptor set with its own layout and pool. Every binding must be set before use.
class DescriptorSet {
  public:
    DescriptorSet(const Device& device, std::span<const Binding> bindings);
    vk::DescriptorSetLayout layout() const { return *layout_; }
    vk::DescriptorSet handle() const { return set_; }
    void set_buffer(uint32_t binding, const Buffer& buffer, uint32_t element = 0) const;
    void set_texels(uint32_t binding, vk::BufferView texels, uint32_t element = 0) const;
    /// `bytes` of a buffer, from an offset that is given when the set is bound.
    void set_window(uint32_t binding, const Buffer& buffer, vk::DeviceSize bytes) const;
    void set_acceleration(uint32_t binding, vk::AccelerationStructureKHR acceleration) const;
    /// A texture in layout eShaderReadOnlyOptimal, fetched without a sampler.
    void set_target(uint32_t binding, const Target& texture) const;

  private:
    const Device* device_;
    vk::UniqueDescriptorSetLayout layout_;
    vk::UniqueDescriptorPool pool_;
    vk::DescriptorSet set_;
};

/// A pipeline layout with these descriptor sets, from set 0 on, and `push_bytes` bytes of push constants for `stages`.
vk::UniquePipelineLayout make_layout(const Device& device, std::span<const vk::DescriptorSetLayout> sets,
                                     vk::ShaderStageFlags stages, uint32_t push_bytes);

vk::UniquePipeline make_compute_pipeline(const Device& device, vk::PipelineLayout layout, SpirV code,
                                         SpecConstants constants);

struct RasterShaders {
    SpirV vertex;
    SpirV fragment;
};

/// A pipeline that draws triangles without vertex buffers, culling or blending, with depth test `greater` (reversed
/// depth). Viewport and scissor are dynamic.
vk::UniquePipeline make_raster_pipeline(const Device& device, vk::PipelineLayout layout, RasterShaders code,
                                        SpecConstants constants, vk::Format color, vk::Format depth);

}  // namespace lw
