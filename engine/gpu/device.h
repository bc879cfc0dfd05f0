// A Vulkan 1.3 device with one queue that does graphics, compute and timestamps. Knows no scene and no photons.
// Required features: scalarBlockLayout, dynamicRendering, synchronization2, maintenance4. Without such a device: one
// Error. Used where the device has them: ray queries.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan.hpp>

namespace lw {

/// Who finds the triangles that rays meet: the device's ray queries (VK_KHR_ray_query), or a traversal in compute.
enum class Rays { fastest, queries, compute };  // fastest: queries, but compute where both run on a processor
/// By their names in options.
inline const std::vector<std::pair<std::string, Rays>> rays_names{
    {"fastest", Rays::fastest}, {"queries", Rays::queries}, {"compute", Rays::compute}};
inline constexpr const char* rays_help =
    "who traces the rays of a picture: compute, queries (VK_KHR_ray_query, an error on a device without), or fastest: "
    "queries on a GPU that has them, else compute";
/// The one of this name, which must be among rays_names.
Rays rays_named(const std::string& name);

struct DeviceSettings {
    std::string name;         // part of the device's name, any case; empty: discrete before integrated before CPU
    bool validation = false;  // Khronos validation layer with synchronization checks
    std::vector<std::string> window_extensions{};  // of the instance; any: the device must be able to present
    vk::DeviceSize memory_bytes = 0;               // most that may be used; 0: what the device has to give
    Rays rays = Rays::fastest;
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
    /// The driver and its version in its own words, such as "Mesa 22.3.6".
    std::string driver() const;
    const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    /// True when rays are to be traced by ray queries.
    bool ray_queries() const { return ray_functions_.has_value(); }
    /// Of the extensions that come with ray queries, which the loader does not export.
    const vk::DispatchLoaderDynamic& ray_functions() const { return *ray_functions_; }
    /// Size of the largest heap of device-local memory, bytes.
    vk::DeviceSize memory_size() const;
    /// Bytes that may be used of it now, `held` bytes being in use by this program: what the driver says is left
    /// (VK_EXT_memory_budget, else what is not held), at most what is left of the settings' memory_bytes.
    vk::DeviceSize memory_budget(vk::DeviceSize held = 0) const;
    /// Index of a memory type among `allowed` bits with all `wanted` properties, or -1.
    int find_memory_type(uint32_t allowed, vk::MemoryPropertyFlags wanted) const;
    /// What the validation layer said so far; empty without validation.
    std::vector<std::string> validation_messages() const;

  private:
    void create_instance(const DeviceSettings& settings);
    void create_device(bool presents, bool ray_queries);

    std::unique_ptr<ValidationLog> log_;
    vk::UniqueInstance instance_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    vk::PhysicalDevice physical_;
    uint32_t queue_family_ = 0;
    std::string name_;
    vk::PhysicalDeviceLimits limits_;
    vk::DeviceSize memory_bytes_ = 0;
    vk::UniqueDevice device_;
    std::optional<vk::DispatchLoaderDynamic> ray_functions_;
    vk::Queue queue_;
    vk::UniqueCommandPool command_pool_;
};

/// Names of all Vulkan devices, best first, those unfit with the reason in parentheses. Empty without Vulkan.
std::vector<std::string> device_names();

}  // namespace lw
