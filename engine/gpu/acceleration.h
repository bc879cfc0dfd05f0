// Acceleration structures for ray queries: triangles, and one instance of them.
// Vulkan specification, chapters "Acceleration Structures" and "Ray Queries".
#pragma once
#include <glm/glm.hpp>

#include "gpu/buffer.h"

namespace lw {

/// The triangles of an acceleration structure, in two geometries. Rays end at triangles of geometry 0, which is opaque.
/// For each triangle of geometry 1 that a ray meets, the shader decides, and is asked only once.
struct TracedTriangles {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> corners;  // indices into `positions`, per triangle, geometry 0 first; at least one
    size_t opaque = 0;                    // triangles of geometry 0
};

class Acceleration {
  public:
    /// Builds on the device and waits. Needs Device::ray_queries(). Throws Error when there is not enough memory.
    Acceleration(const Device& device, const TracedTriangles& triangles);
    Acceleration(Acceleration&&) = default;
    Acceleration& operator=(Acceleration&&) = delete;  // would free the buffers before the structures in them
    /// For a descriptor (DescriptorSet::set_acceleration).
    vk::AccelerationStructureKHR handle() const { return *scene_.handle; }
    vk::DeviceSize bytes() const { return triangles_.buffer.size() + scene_.buffer.size(); }

  private:
    struct Level {
        Buffer buffer;
        vk::UniqueHandle<vk::AccelerationStructureKHR, vk::DispatchLoaderDynamic> handle;
    };
    Level build(const Device& device, vk::AccelerationStructureTypeKHR type,
                std::span<const vk::AccelerationStructureGeometryKHR> geometries,
                std::span<const vk::AccelerationStructureBuildRangeInfoKHR> ranges) const;
    Level triangles_, scene_;
};

}  // namespace lw
