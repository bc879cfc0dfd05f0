// A Vulkan 1.3 device with one queue that does graphics, compute and timestamps. Knows no scene and no photons.
// Required features: scalarBlockLayout, dynamicRendering, synchronization2, maintenance4. Without such a device: one
// Error.
#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan.hpp>

namespace lw {

struct DeviceSettings {
    std::string name;         // part of the device's name, any case; empty: discrete before integrated before CPU
    bool validation = false;  // Khronos validation layer with synchronization checks
    std::vector<std::string> window_extensions{};  // of the instance; any: the device must be able to present
    vk::DeviceSize memory_bytes = 0;               // most that may be used; 0: what the device has to give
};

/// Errors and warnings of the validation layer, in order; filled from any thread.
struct ValidationLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

class Device {
  public:
    /// Throws Error when there is no Vulkan, no device of that name, or one that lacks what is needed (named).
    explicit Device(const DeviceSettings& settings = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    vk::Device handle() const { return *device_; }
    vk::Instance instance() const { return *instance_; }
    uint32_t queue_family() const { return queue_family_; }
    vk::PhysicalDevice physical() const { return physical_; }
    vk::Queue queue() const { return queue_; }
    vk::CommandPool command_pool() const { return *command_pool_; }
    const std::string& name() const { return name_; }
    const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    /// Size of the largest heap of device-local memory, bytes.
    vk::DeviceSize memory_size() const;
    /// Bytes that may be used of it now: what the driver says is left (VK_EXT_memory_budget, else all), at most the
    /// settings' memory_bytes.
    vk::DeviceSize memory_budget() const;
    /// Index of a memory type among `allowed` bits with all `wanted` properties, or -1.
    int find_memory_type(uint32_t allowed, vk::MemoryPropertyFlags wanted) const;
    /// What the validation layer said so far; empty without validation.
    std::vector<std::string> validation_messages() const;

  private:
    void create_instance(const DeviceSettings& settings);
    void create_device(bool presents);

    std::unique_ptr<ValidationLog> log_;
    vk::UniqueInstance instance_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    vk::PhysicalDevice physical_;
    uint32_t queue_family_ = 0;
    std::string name_;
    vk::PhysicalDeviceLimits limits_;
    vk::DeviceSize memory_bytes_ = 0;
    vk::UniqueDevice device_;
    vk::Queue queue_;
    vk::UniqueCommandPool command_pool_;
};

/// Names of all Vulkan devices, best first, those unfit with the reason in parentheses. Empty without Vulkan.
std::vector<std::string> device_names();

}  // namespace lw
