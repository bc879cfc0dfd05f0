#include "gpu/pipeline.h"

#include <array>
#include <map>

namespace lw {
namespace {

vk::UniqueShaderModule make_module(const Device& device, SpirV code, SpecConstants constants) {
    const std::vector<uint32_t> specialized = specialize(code, constants);
    return device.handle().createShaderModuleUnique({{}, specialized.size() * sizeof(uint32_t), specialized.data()});
}

vk::UniqueDescriptorPool make_pool(const Device& device, std::span<const Binding> bindings) {
    std::map<vk::DescriptorType, uint32_t> counts;
    for (const Binding& b : bindings) counts[b.type] += b.count;
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) sizes.emplace_back(type, count);
    return device.handle().createDescriptorPoolUnique({{}, 1, sizes});
}

}  // namespace

DescriptorSet::DescriptorSet(const Device& device, std::span<const Binding> bindings) : device_(&device) {
    std::vector<vk::DescriptorSetLayoutBinding> layout_bindings;
    for (const Binding& b : bindings) layout_bindings.emplace_back(b.binding, b.type, b.count, b.stages);
    layout_ = device.handle().createDescriptorSetLayoutUnique({{}, layout_bindings});
    pool_ = make_pool(device, bindings);
    set_ = device.handle().allocateDescriptorSets({*pool_, *layout_})[0];
}

void DescriptorSet::set_buffer(uint32_t binding, const Buffer& buffer, uint32_t element) const {
    const vk::DescriptorBufferInfo what(buffer.handle(), 0, VK_WHOLE_SIZE);
    const vk::WriteDescriptorSet write(set_, binding, element, vk::DescriptorType::eStorageBuffer, {}, what);
    device_->handle().updateDescriptorSets(write, {});
}

void DescriptorSet::set_texels(uint32_t binding, vk::BufferView texels, uint32_t element) const {
    const vk::WriteDescriptorSet write(set_, binding, element, vk::DescriptorType::eUniformTexelBuffer, {}, {}, texels);
    device_->handle().updateDescriptorSets(write, {});
}

void DescriptorSet::set_window(uint32_t binding, const Buffer& buffer, vk::DeviceSize bytes) const {
    const vk::DescriptorBufferInfo what(buffer.handle(), 0, bytes);
    const vk::WriteDescriptorSet write(set_, binding, 0, vk::DescriptorType::eStorageBufferDynamic, {}, what);
    device_->handle().updateDescriptorSets(write, {});
}

void DescriptorSet::set_acceleration(uint32_t binding, vk::AccelerationStructureKHR acceleration) const {
    const vk::WriteDescriptorSetAccelerationStructureKHR what(acceleration);
    vk::WriteDescriptorSet write(set_, binding, 0, 1, vk::DescriptorType::eAccelerationStructureKHR);
    write.pNext = &what;
    device_->handle().updateDescriptorSets(write, {});
}

void DescriptorSet::set_target(uint32_t binding, const Target& texture) const {
    const vk::DescriptorImageInfo what({}, texture.view(), vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::WriteDescriptorSet write(set_, binding, 0, vk::DescriptorType::eSampledImage, what);
    device_->handle().updateDescriptorSets(write, {});
}

vk::UniquePipelineLayout make_layout(const Device& device, std::span<const vk::DescriptorSetLayout> sets,
                                     vk::ShaderStageFlags stages, uint32_t push_bytes) {
    const vk::PushConstantRange range(stages, 0, push_bytes);
    return device.handle().createPipelineLayoutUnique({{}, uint32_t(sets.size()), sets.data(), 1, &range});
}

vk::UniquePipeline make_compute_pipeline(const Device& device, vk::PipelineLayout layout, SpirV code,
                                         SpecConstants constants) {
    const vk::UniqueShaderModule shader = make_module(device, code, constants);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main");
    return device.handle()
        .createComputePipelineUnique({}, {vk::PipelineCreateFlagBits::eDispatchBase, stage, layout})
        .value;
}

vk::UniquePipeline make_raster_pipeline(const Device& device, vk::PipelineLayout layout, RasterShaders code,
                                        SpecConstants constants, vk::Format color, vk::Format depth) {
    const vk::UniqueShaderModule vertex = make_module(device, code.vertex, constants);
    const vk::UniqueShaderModule fragment = make_module(device, code.fragment, constants);
    const std::array stages{
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
    const vk::PipelineVertexInputStateCreateInfo no_vertices;
    const vk::PipelineInputAssemblyStateCreateInfo list({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1.0f;
    const vk::PipelineMultisampleStateCreateInfo one_sample;
    const vk::PipelineDepthStencilStateCreateInfo depth_test({}, true, true, vk::CompareOp::eGreater);
    vk::PipelineColorBlendAttachmentState plain;
    plain.colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags;
    const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, plain);
    const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamic_states);
    const vk::PipelineRenderingCreateInfo targets(0, color, depth);
    vk::GraphicsPipelineCreateInfo pipeline({}, stages, &no_vertices, &list, nullptr, &viewport, &raster, &one_sample,
                                            &depth_test, &blend, &dynamic, layout);
    pipeline.pNext = &targets;
    return device.handle().createGraphicsPipelineUnique({}, pipeline).value;
}

}  // namespace lw
