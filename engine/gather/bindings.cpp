#include "gather/bindings.h"

#include "shaders/frame.h"

namespace lw {
namespace {

constexpr auto texels = vk::DescriptorType::eUniformTexelBuffer, storage = vk::DescriptorType::eStorageBuffer,
               storage_window = vk::DescriptorType::eStorageBufferDynamic, image = vk::DescriptorType::eSampledImage,
               hierarchy = vk::DescriptorType::eAccelerationStructureKHR;
constexpr vk::ShaderStageFlags vertex = vk::ShaderStageFlagBits::eVertex, compute = vk::ShaderStageFlagBits::eCompute,
                               all_stages = vertex | vk::ShaderStageFlagBits::eFragment | compute;

struct Row {
    BindingSet set;
    Binding binding;
};

const Row table[] = {
#define LW_BINDING(set, name, type, count, stages) {BindingSet::set, {binding_##name, type, count, stages}},
#include "shaders/binding_table.h"
#undef LW_BINDING
};

}  // namespace

std::vector<Binding> bindings_of(BindingSet set) {
    std::vector<Binding> bindings;
    for (const Row& row : table)
        if (row.set == set) bindings.push_back(row.binding);
    return bindings;
}

}  // namespace lw
