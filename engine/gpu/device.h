// A Vulkan 1.3 device with one queue that does graphics, compute and timestamps. Knows no scene and no photons.
// Requires the features scalarBlockLayout, dynamicRendering, synchronization2 and maintenance4, and throws Error
// without a device that has them. Ray queries are used where the device has them.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan.hpp>

namespace lw {

/// How rays find triangles: by the device's ray queries (VK_KHR_ray_query), or by a traversal in a compute shader.
enum class Rays {
    fastest,
    queries,
    compute
};  // fastest: queries on a GPU that has them; compute on a software rasterizer
/// By their names in options.
inline const std::vector<std::pair<std::string, Rays>> rays_names{
    {"fastest", Rays::fastest}, {"queries", Rays::queries}, {"compute", Rays::compute}};
inline constexpr const char* rays_help =
    "who traces the rays of a picture: compute, queries (VK_KHR_ray_query, an error on a device without), or fastest: "
    "queries on a GPU that has them, else compute";
/// The value of a name among rays_names.
Rays rays_named(const std::string& name);

struct DeviceSettings {
    std::string name;  // part of the device's name, any case; empty: a discrete GPU, else an integrated one, else a CPU
    bool validation = false;  // Khronos validation layer with synchronization checks
    std::vector<std::string>
        window_extensions{};          // of the instance; when there are any, the device must be able to present
    vk::DeviceSize memory_bytes = 0;  // most device memory to use; 0: all that the device has
    Rays rays = Rays::fastest;
};

/// Errors and warnings of the validation layer, in the order they came. Any thread may add to it.
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
    /// The driver's name and version as it states them, such as "Mesa 22.3.6".
    std::string driver() const;
    const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    /// True when rays are traced by ray queries, as the settings and the device allow.
    bool ray_queries() const { return ray_functions_.has_value(); }
    /// The functions of the ray query extensions, which the loader does not export. Only when ray_queries().
    const vk::DispatchLoaderDynamic& ray_functions() const { return *ray_functions_; }
    /// Size of the largest heap of device-local memory, bytes.
    vk::DeviceSize memory_size() const;
    /// Bytes of that heap that may be used now, when this program already uses `held` bytes of it. What the driver says
    /// is left (VK_EXT_memory_budget; without it, the heap less `held`), but no more than the settings' memory_bytes
    /// less `held`.
    vk::DeviceSize memory_budget(vk::DeviceSize held = 0) const;
    /// Index of a memory type among `allowed` bits with all `wanted` properties, or -1.
    int find_memory_type(uint32_t allowed, vk::MemoryPropertyFlags wanted) const;
    /// All messages of the validation layer so far; none without validation.
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
