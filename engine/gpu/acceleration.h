// Acceleration structures for ray queries: triangles, and one instance of them.
// Vulkan specification, chapters "Acceleration Structures" and "Ray Queries".
#pragma once
#include <glm/glm.hpp>

#include "gpu/buffer.h"

namespace lw {

/// Geometry 0 is opaque: rays end there by themselves. Triangles of geometry 1 are candidates that the shader decides
/// on, each once.
struct TracedTriangles {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> corners;  // of the triangles of geometry 0, then of geometry 1; at least one
    size_t opaque = 0;                    // triangles of geometry 0
};

class Acceleration {
  public:
    /// Builds on the device and waits. Needs Device::ray_queries(). Throws Error when there is not enough memory.
    Acceleration(const Device& device, const TracedTriangles& triangles);
    Acceleration(Acceleration&&) = default;
    Acceleration& operator=(Acceleration&&) = delete;  // would free buffers before what lies in them
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
