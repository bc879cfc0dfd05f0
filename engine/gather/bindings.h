// The rows of shaders/binding_table.h as Vulkan's bindings, by descriptor set.
#pragma once
#include <vector>

#include "gpu/pipeline.h"

namespace lw {

enum class BindingSet { scene, picture, cull, view, lamp_sum };

/// The bindings of one descriptor set, in the order of the table.
std::vector<Binding> bindings_of(BindingSet set);

}  // namespace lw
