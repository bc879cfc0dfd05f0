// A scene and its photon map in GPU memory, as descriptor set 0 of all passes (shaders/frame.h).
// The arrays are uploaded as they are; photon records beyond maxStorageBufferRange are split over several buffers.
#pragma once
#include <array>
#include <span>

#include "gpu/pipeline.h"
#include "maps/photon_map.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "shaders/frame.h"

namespace lw {

using ShaderConstants = std::array<uint32_t, constant_count>;

struct ResidentSettings {
    uint64_t buffer_range = 0;  // bytes of one storage buffer; 0: what the device allows. For tests of the splitting.
};

class Resident {
  public:
    /// Uploads everything; all lights at factor 1. The map must outlive it; one without triangle_maps means no photons.
    /// Without `bvh` no rays are traced: no shadow rays, and mirrors are black.
    /// Throws Error saying which array does not fit, and what would.
    Resident(const Device& device, const Scene& scene, const PhotonMap& map, const Bvh& bvh = {},
             ResidentSettings settings = {});
    Resident(const Device&, const Scene&, PhotonMap&&, const Bvh& = {},
             ResidentSettings = {}) = delete;  // would not outlive it

    /// Dims and tints the lights: one factor per light of the scene, >= 0. Rewrites two small buffers.
    void set_light_factors(std::span<const vec3> factors);
    void set_light_factors(std::span<const float> factors);  // the same for R, G and B

    const DescriptorSet& descriptors() const { return descriptors_; }
    /// Specialization constants of the scene; gather_mode and heap_size are left to the pass.
    const ShaderConstants& constants() const { return constants_; }
    uint triangle_count() const { return triangle_count_; }
    /// Each cluster_triangles triangles, in their order.
    struct Cluster {
        vec3 low, high;            // bounds
        bool see_through = false;  // some of them are cut out, blended or transmissive
    };
    const std::vector<Cluster>& clusters() const { return clusters_; }
    float max_radius() const { return max_radius_; }    // m
    float ray_epsilon() const { return ray_epsilon_; }  // m
    float scene_size() const { return scene_size_; }    // m
    float inverse_irradiance_scale() const { return inverse_irradiance_scale_; }
    float inverse_flux_scale() const { return inverse_flux_scale_; }
    uint64_t bytes() const;  // GPU memory of all buffers

  private:
    void choose_constants(const Scene& scene, const PhotonMap& map, const Bvh& bvh);
    void upload_scene(const Scene& scene);
    void upload_map(const PhotonMap& map);
    void upload_direct(const Scene& scene, const Bvh& bvh);
    void write_nodes();
    template <class T>
    void upload_array(uint binding, std::span<const T> values, const std::string& what);
    template <class T>
    void upload_chunks(uint binding, std::span<const T> values, uint shift, const std::string& what);

    const Device* device_;
    const PhotonMap* map_;
    uint64_t buffer_range_;
    ShaderConstants constants_{};
    uint triangle_count_;
    std::vector<Cluster> clusters_;
    float max_radius_;
    float inverse_flux_scale_;
    float ray_epsilon_;
    float scene_size_;
    std::vector<Lamp> lamp_states_;
    DescriptorSet descriptors_;
    std::vector<Buffer> buffers_;
    Buffer lamps_;
    size_t nodes_ = 0;  // index of their buffer
    float inverse_irradiance_scale_ = 1;
};

}  // namespace lw
