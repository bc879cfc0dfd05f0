// A Vulkan layer that makes the device under it fail as told by LUMENWALK_FAULT, one word or several with commas:
//   lost=N            the Nth submission to a queue loses the device, and all that follow
//   lost-once=N       the Nth submission loses the device; one made anew works
//   memory=MIB        the largest heap of the device has that many MiB, and allocations beyond it fail
//   no-memory=N       the Nth allocation fails, whatever the heap
//   limit=NAME:VALUE  maxTexelBufferElements, maxStorageBufferRange, maxImageDimension2D,
//                     maxPerStageDescriptorSampledImages or apiVersion (1000 x major + minor)
//   feature=NAME      scalarBlockLayout, dynamicRendering, synchronization2 or maintenance4 is missing
// One instance and one device at a time: made for tests of whole programs.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

PFN_vkGetInstanceProcAddr next_of_instance = nullptr;
PFN_vkGetDeviceProcAddr next_of_device = nullptr;
VkInstance the_instance = VK_NULL_HANDLE;
VkDevice the_device = VK_NULL_HANDLE;
std::atomic<uint64_t> submissions{0}, allocations{0}, allocated{0};

/// The text after NAME= in LUMENWALK_FAULT, or nullptr.
const char* fault(const char* name) {
    static std::string found;
    const char* all = std::getenv("LUMENWALK_FAULT");
    const std::string words = std::string(",") + (all ? all : ""), key = std::string(",") + name + "=";
    const size_t at = words.find(key);
    if (at == std::string::npos) return nullptr;
    found = words.substr(at + key.size(), words.find(',', at + 1) - at - key.size());
    return found.c_str();
}

uint64_t number(const char* name, uint64_t otherwise) {
    const char* text = fault(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// What lies below, asked while the chain is made: later the loader answers with the top of the chain.
PFN_vkGetPhysicalDeviceProperties next_get_properties = nullptr;
PFN_vkGetPhysicalDeviceFeatures2 next_get_features = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties next_get_memory = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties2 next_get_memory2 = nullptr;
PFN_vkQueueSubmit2 next_submit = nullptr;
PFN_vkAllocateMemory next_allocate = nullptr;

template <class F>
void ask_instance(F& function, const char* name) {
    function = reinterpret_cast<F>(next_of_instance(the_instance, name));
}

template <class F>
void ask_device(F& function, const char* name) {
    function = reinterpret_cast<F>(next_of_device(the_device, name));
}

void bend(VkPhysicalDeviceProperties& p) {
    const char* text = fault("limit");
    const char* colon = text ? std::strchr(text, ':') : nullptr;
    if (!colon) return;
    const std::string name(text, colon);
    const auto value = uint32_t(std::strtoul(colon + 1, nullptr, 10));
    if (name == "maxTexelBufferElements") p.limits.maxTexelBufferElements = value;
    if (name == "maxStorageBufferRange") p.limits.maxStorageBufferRange = value;
    if (name == "maxImageDimension2D") p.limits.maxImageDimension2D = value;
    if (name == "maxPerStageDescriptorSampledImages") p.limits.maxPerStageDescriptorSampledImages = value;
    if (name == "apiVersion") p.apiVersion = VK_MAKE_API_VERSION(0, value / 1000, value % 1000, 0);
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
    next_get_properties(device, properties);
    bend(*properties);
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
    next_get_features(device, features);
    const char* text = fault("feature");
    const std::string name = text ? text : "";
    for (auto* p = static_cast<VkBaseOutStructure*>(features->pNext); p; p = p->pNext) {
        if (p->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES && name == "scalarBlockLayout")
            reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(p)->scalarBlockLayout = VK_FALSE;
        if (p->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) continue;
        auto& f = *reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(p);
        if (name == "dynamicRendering") f.dynamicRendering = VK_FALSE;
        if (name == "synchronization2") f.synchronization2 = VK_FALSE;
        if (name == "maintenance4") f.maintenance4 = VK_FALSE;
    }
}

VKAPI_ATTR void VKAPI_CALL get_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
    next_get_memory(device, memory);
    const uint64_t most = number("memory", UINT64_MAX >> 20) << 20;
    for (uint32_t i = 0; i < memory->memoryHeapCount; ++i)
        memory->memoryHeaps[i].size = std::min<uint64_t>(memory->memoryHeaps[i].size, most);
}

VKAPI_ATTR void VKAPI_CALL get_memory2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* memory) {
    next_get_memory2(device, memory);
    const uint64_t most = number("memory", UINT64_MAX >> 20) << 20;
    for (uint32_t i = 0; i < memory->memoryProperties.memoryHeapCount; ++i)
        memory->memoryProperties.memoryHeaps[i].size =
            std::min<uint64_t>(memory->memoryProperties.memoryHeaps[i].size, most);
    for (auto* p = static_cast<VkBaseOutStructure*>(memory->pNext); p; p = p->pNext)
        if (p->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT)
            for (uint32_t i = 0; i < VK_MAX_MEMORY_HEAPS; ++i) {
                auto* told = reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(p);
                told->heapBudget[i] = std::min<uint64_t>(told->heapBudget[i], most);
                told->heapUsage[i] = 0;  // some drivers count what the whole machine uses
            }
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo2* what, VkFence fence) {
    const uint64_t n = ++submissions;
    if (n >= number("lost", UINT64_MAX) || n == number("lost-once", UINT64_MAX)) return VK_ERROR_DEVICE_LOST;
    return next_submit(queue, count, what, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* what,
                                        const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    const uint64_t most = number("memory", UINT64_MAX >> 20) << 20;
    if (++allocations == number("no-memory", UINT64_MAX) || allocated + what->allocationSize > most)
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    allocated += what->allocationSize;  // freeing is not followed: peaks are what is bounded
    return next_allocate(device, what, callbacks, memory);
}

/// The link of this layer in the chain that the loader made; it moves on to the next layer's.
template <class Info>
Info* link_in(const void* chain, VkStructureType type) {
    for (auto* p = static_cast<const Info*>(chain); p; p = static_cast<const Info*>(p->pNext))
        if (p->sType == type && p->function == VK_LAYER_LINK_INFO) return const_cast<Info*>(p);
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                                               VkInstance* instance) {
    auto* link = link_in<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(next_of_instance(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, callbacks, instance);
    if (result != VK_SUCCESS) return result;
    the_instance = *instance;
    ask_instance(next_get_properties, "vkGetPhysicalDeviceProperties");
    ask_instance(next_get_features, "vkGetPhysicalDeviceFeatures2");
    ask_instance(next_get_memory, "vkGetPhysicalDeviceMemoryProperties");
    ask_instance(next_get_memory2, "vkGetPhysicalDeviceMemoryProperties2");
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks, VkDevice* device) {
    auto* link = link_in<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(next(the_instance, "vkCreateDevice"));
    const VkResult result = create(physical, info, callbacks, device);
    if (result != VK_SUCCESS) return result;
    the_device = *device;
    ask_device(next_submit, "vkQueueSubmit2");
    ask_device(next_allocate, "vkAllocateMemory");
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name);

PFN_vkVoidFunction own_function(const std::string& name) {
    const struct {
        const char* name;
        PFN_vkVoidFunction function;
    } functions[] = {
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(create_instance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(create_device)},
        {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(instance_function)},
        {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(device_function)},
        {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(get_properties)},
        {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(get_features)},
        {"vkGetPhysicalDeviceMemoryProperties", reinterpret_cast<PFN_vkVoidFunction>(get_memory)},
        {"vkGetPhysicalDeviceMemoryProperties2", reinterpret_cast<PFN_vkVoidFunction>(get_memory2)},
        {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(submit)},
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocate)},
    };
    for (const auto& f : functions)
        if (name == f.name) return f.function;
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
    if (const PFN_vkVoidFunction own = own_function(name)) return own;
    return next_of_device ? next_of_device(device, name) : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
    if (const PFN_vkVoidFunction own = own_function(name)) return own;
    return next_of_instance ? next_of_instance(instance, name) : nullptr;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = instance_function;
    version->pfnGetDeviceProcAddr = device_function;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
