// Preloaded into lumenwalk (LD_PRELOAD), it loses the graphics device as a driver does that is reset: at the first
// submission after the file LUMENWALK_LOSE_WHEN has come to be, which it removes, and from then on every call on that
// device answers VK_ERROR_DEVICE_LOST until it is destroyed.
#include <dlfcn.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <map>

namespace {

std::map<VkQueue, VkDevice> devices;
VkDevice lost = VK_NULL_HANDLE;

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_time() {
    const char* file = std::getenv("LUMENWALK_LOSE_WHEN");
    return file && unlink(file) == 0;
}

}  // namespace

extern "C" {

void vkGetDeviceQueue(VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
    next<decltype(vkGetDeviceQueue)>("vkGetDeviceQueue")(device, family, index, queue);
    devices[*queue] = device;
}

VkResult vkQueueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
    if (is_time()) lost = devices[queue];
    if (lost && devices[queue] == lost) return VK_ERROR_DEVICE_LOST;
    return next<decltype(vkQueueSubmit2)>("vkQueueSubmit2")(queue, count, infos, fence);
}

VkResult vkWaitForFences(VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t timeout) {
    if (device == lost) return VK_ERROR_DEVICE_LOST;
    return next<decltype(vkWaitForFences)>("vkWaitForFences")(device, count, fences, all, timeout);
}

VkResult vkDeviceWaitIdle(VkDevice device) {
    const VkResult result = next<decltype(vkDeviceWaitIdle)>("vkDeviceWaitIdle")(device);
    return device == lost ? VK_ERROR_DEVICE_LOST : result;
}

void vkDestroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (device == lost) lost = VK_NULL_HANDLE;
    next<decltype(vkDestroyDevice)>("vkDestroyDevice")(device, allocator);
}

}  // extern "C"
