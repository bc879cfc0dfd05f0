#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <optional>

#include "base/error.h"

namespace lw {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL record_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    ValidationLog& log = *static_cast<ValidationLog*>(user);
    std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_settings(ValidationLog& log) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    return vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation, record_message,
                                                &log);
}

vk::ApplicationInfo application() { return vk::ApplicationInfo("lumenwalk", 1, "lumenwalk", 1, VK_API_VERSION_1_3); }

bool has_layer(const char* name) {
    for (const vk::LayerProperties& layer : vk::enumerateInstanceLayerProperties())
        if (std::string(layer.layerName.data()) == name) return true;
    return false;
}

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string name_of(vk::PhysicalDevice device) { return device.getProperties().deviceName.data(); }

int rank(vk::PhysicalDevice device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 1;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        case vk::PhysicalDeviceType::eCpu:
            return 3;
        default:
            return 4;
    }
}

std::vector<vk::PhysicalDevice> devices_best_first(vk::Instance instance) {
    std::vector<vk::PhysicalDevice> devices = instance.enumeratePhysicalDevices();
    std::stable_sort(devices.begin(), devices.end(), [](auto a, auto b) { return rank(a) < rank(b); });
    return devices;
}

std::optional<uint32_t> queue_family_of(vk::PhysicalDevice device) {
    const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    const auto families = device.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits > 0) return i;
    return std::nullopt;
}

bool has_extension(vk::PhysicalDevice device, const char* name) {
    for (const vk::ExtensionProperties& extension : device.enumerateDeviceExtensionProperties())
        if (std::string(extension.extensionName.data()) == name) return true;
    return false;
}

constexpr const char* ray_query_extensions[] = {VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                                VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

bool has_ray_queries(vk::PhysicalDevice device) {
    for (const char* name : ray_query_extensions)
        if (!has_extension(device, name)) return false;
    const auto chain =
        device
            .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                          vk::PhysicalDeviceAccelerationStructureFeaturesKHR, vk::PhysicalDeviceRayQueryFeaturesKHR>();
    return chain.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress &&
           chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure &&
           chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery;
}

bool wants_queries(Rays rays, vk::PhysicalDevice device) {
    const bool is_processor = device.getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    return rays == Rays::queries || (rays == Rays::fastest && !is_processor);
}

/// Names what the device lacks of the requirements, or is empty. `presents`: it must show pictures in a window too.
std::string lack_of(vk::PhysicalDevice device, bool presents = false) {
    const uint32_t version = device.getProperties().apiVersion;
    if (version < VK_API_VERSION_1_3)
        return "Vulkan 1.3, has " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
               std::to_string(VK_API_VERSION_MINOR(version));
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                           vk::PhysicalDeviceVulkan13Features>();
    if (!chain.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout) return "feature scalarBlockLayout";
    if (!chain.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering) return "feature dynamicRendering";
    if (!chain.get<vk::PhysicalDeviceVulkan13Features>().synchronization2) return "feature synchronization2";
    if (!chain.get<vk::PhysicalDeviceVulkan13Features>().maintenance4) return "feature maintenance4";
    if (!queue_family_of(device)) return "a queue for graphics and compute with timestamps";
    if (presents && !has_extension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME))
        return "extension " VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    return "";
}

std::string list_names(const std::vector<vk::PhysicalDevice>& devices) {
    std::string names;
    for (vk::PhysicalDevice device : devices) names += (names.empty() ? "" : ", ") + name_of(device);
    return names;
}

/// The first of the devices, best first, that meets the requirements and whose name contains `name`.
vk::PhysicalDevice choose(const std::vector<vk::PhysicalDevice>& devices, const std::string& name, bool presents) {
    if (devices.empty()) throw Error("Vulkan: no device found (mesa-vulkan-drivers has one that runs on the CPU)");
    std::string unfit;
    for (vk::PhysicalDevice device : devices) {
        if (lower(name_of(device)).find(lower(name)) == std::string::npos) continue;
        const std::string lack = lack_of(device, presents);
        if (lack.empty()) return device;
        unfit += (unfit.empty() ? "" : "; ") + name_of(device) + " lacks " + lack;
    }
    if (!unfit.empty()) throw Error("Vulkan: " + unfit);
    throw Error("Vulkan: no device is called \"" + name + "\"; there are: " + list_names(devices));
}

}  // namespace

Rays rays_named(const std::string& name) {
    const auto found =
        std::find_if(rays_names.begin(), rays_names.end(), [&](const auto& r) { return r.first == name; });
    assert(found != rays_names.end());
    return found->second;
}

Device::Device(const DeviceSettings& settings) {
    try {
        const bool presents = !settings.window_extensions.empty();
        create_instance(settings);
        physical_ = choose(devices_best_first(*instance_), settings.name, presents);
        name_ = name_of(physical_);
        limits_ = physical_.getProperties().limits;
        memory_bytes_ = settings.memory_bytes;
        const bool ray_queries = wants_queries(settings.rays, physical_) && has_ray_queries(physical_);
        if (settings.rays == Rays::queries && !ray_queries)
            throw Error("Vulkan: " + name_ + " lacks ray queries (" + VK_KHR_RAY_QUERY_EXTENSION_NAME + ")");
        create_device(presents, ray_queries);
    } catch (const vk::IncompatibleDriverError&) {
        throw Error("Vulkan: no driver found (mesa-vulkan-drivers has one that runs on the CPU)");
    } catch (const vk::SystemError& failure) {
        throw Error("Vulkan: cannot be started: " + std::string(failure.what()));
    }
}

Device::~Device() {
    if (!messenger_) return;
    auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance_->getProcAddr("vkDestroyDebugUtilsMessengerEXT"));
    command_pool_.reset();
    device_.reset();
    destroy(*instance_, messenger_, nullptr);
}

void Device::create_instance(const DeviceSettings& settings) {
    const vk::ApplicationInfo app = application();
    std::vector<const char*> extensions;
    for (const std::string& name : settings.window_extensions) extensions.push_back(name.c_str());
    if (!settings.validation) {
        instance_ = vk::createInstanceUnique(vk::InstanceCreateInfo({}, &app, {}, extensions));
        return;
    }
    if (!has_layer(validation_layer))
        throw Error(std::string("Vulkan: ") + validation_layer + " is not installed (vulkan-validationlayers)");
    log_ = std::make_unique<ValidationLog>();
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const vk::ValidationFeatureEnableEXT checks[] = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    vk::StructureChain<vk::InstanceCreateInfo, vk::ValidationFeaturesEXT, vk::DebugUtilsMessengerCreateInfoEXT> chain(
        vk::InstanceCreateInfo({}, &app, validation_layer, extensions), vk::ValidationFeaturesEXT(checks),
        messenger_settings(*log_));
    instance_ = vk::createInstanceUnique(chain.get<vk::InstanceCreateInfo>());
    auto create =
        reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(instance_->getProcAddr("vkCreateDebugUtilsMessengerEXT"));
    const VkDebugUtilsMessengerCreateInfoEXT info = messenger_settings(*log_);
    if (create(*instance_, &info, nullptr, &messenger_) != VK_SUCCESS)
        throw Error("Vulkan: the validation layer cannot report");
}

void Device::create_device(bool presents, bool ray_queries) {
    queue_family_ = *queue_family_of(physical_);
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue_info({}, queue_family_, 1, &priority);
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features,
                       vk::PhysicalDeviceAccelerationStructureFeaturesKHR, vk::PhysicalDeviceRayQueryFeaturesKHR>
        chain;
    chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue_info);
    std::vector<const char*> extensions;
    if (presents) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (ray_queries) {
        extensions.insert(extensions.end(), std::begin(ray_query_extensions), std::end(ray_query_extensions));
        chain.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress = true;
        chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure = true;
        chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery = true;
    } else {
        chain.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
        chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    }
    chain.get<vk::DeviceCreateInfo>().setPEnabledExtensionNames(extensions);
    chain.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout = true;
    chain.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering = true;
    chain.get<vk::PhysicalDeviceVulkan13Features>().synchronization2 = true;
    chain.get<vk::PhysicalDeviceVulkan13Features>().maintenance4 = true;  // glslang writes LocalSizeId, which needs it
    device_ = physical_.createDeviceUnique(chain.get<vk::DeviceCreateInfo>());
    if (ray_queries) ray_functions_.emplace(*instance_, vkGetInstanceProcAddr, *device_, vkGetDeviceProcAddr);
    queue_ = device_->getQueue(queue_family_, 0);
    command_pool_ = device_->createCommandPoolUnique({vk::CommandPoolCreateFlagBits::eTransient, queue_family_});
}

std::string Device::driver() const {
    const auto chain = physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan12Properties>();
    const std::string words = chain.get<vk::PhysicalDeviceVulkan12Properties>().driverInfo.data();
    return words.substr(0, words.find(" ("));
}

vk::DeviceSize Device::memory_size() const {
    const vk::PhysicalDeviceMemoryProperties memory = physical_.getMemoryProperties();
    vk::DeviceSize largest = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            largest = std::max(largest, memory.memoryHeaps[i].size);
    return largest;
}

vk::DeviceSize Device::memory_budget(vk::DeviceSize held) const {
    const auto without_held = [&](vk::DeviceSize bytes) { return bytes - std::min(bytes, held); };
    vk::DeviceSize left = without_held(memory_size());
    if (has_extension(physical_, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME)) {
        const auto chain = physical_.getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2,
                                                          vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
        const vk::PhysicalDeviceMemoryProperties& memory =
            chain.get<vk::PhysicalDeviceMemoryProperties2>().memoryProperties;
        const auto& told = chain.get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
        left = 0;
        for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
            if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
                left = std::max(left, told.heapBudget[i] - std::min(told.heapBudget[i], told.heapUsage[i]));
    }
    return memory_bytes_ > 0 ? std::min(left, without_held(memory_bytes_)) : left;
}

int Device::find_memory_type(uint32_t allowed, vk::MemoryPropertyFlags wanted) const {
    const vk::PhysicalDeviceMemoryProperties memory = physical_.getMemoryProperties();
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return int(i);
    return -1;
}

std::vector<std::string> Device::validation_messages() const {
    if (!log_) return {};
    std::lock_guard lock(log_->mutex);
    return log_->messages;
}

std::vector<std::string> device_names() {
    std::vector<std::string> names;
    try {
        const vk::ApplicationInfo app = application();
        const vk::UniqueInstance instance = vk::createInstanceUnique(vk::InstanceCreateInfo({}, &app));
        for (vk::PhysicalDevice device : devices_best_first(*instance)) {
            const std::string lack = lack_of(device);
            names.push_back(name_of(device) + (lack.empty() ? "" : " (lacks " + lack + ")"));
        }
    } catch (const vk::SystemError&) {
        names.clear();  // without any driver no instance can be made: there are no devices
    }
    return names;
}

}  // namespace lw
