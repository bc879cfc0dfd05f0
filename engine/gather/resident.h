// A scene and its photon map in GPU memory, as descriptor set 0 of all passes (shaders/frame.h).
// The photons' arrays are uploaded as they are, those of the vertices per corner; photon records beyond the device's
// texel buffers are split over several.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "gather/constants.h"
#include "gather/lamp_sum.h"
#include "gpu/acceleration.h"
#include "gpu/pipeline.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "shaders/frame.h"

namespace lw {

struct ResidentSettings {
    uint64_t texels =
        0;  // largest number of records in one buffer; 0: what the device allows. For tests of the splitting.
};

class Resident {
  public:
    /// Uploads everything, with all lights at factor 1. Scene and map must outlive it. A map without grid_of_side is
    /// one without photons. An empty `bvh` means that no rays are traced: lamps throw no shadows, mirrors are black,
    /// and glass is looked straight through. Throws Error saying which array does not fit, and what would.
    Resident(const Device& device, const Scene& scene, const PhotonMap& map, const Bvh& bvh = {},
             ResidentSettings settings = {});
    Resident(const Device&, const Scene&, PhotonMap&&, const Bvh& = {},
             ResidentSettings = {}) = delete;  // would not outlive it

    /// Dims the lights. `factors`: one per light of the scene, >= 0, or RGB. `setting`: 0 or 1; the device keeps two,
    /// so that one frame can show both, and the second takes memory from its first use on. Where the factors are those
    /// that the setting has, nothing is done. Waits until the device is done.
    void set_lamp_factors(std::span<const float> factors, uint setting = 0);
    void set_lamp_factors(std::span<const vec3> factors, uint setting = 0);
    /// Dims the lights by commands of a frame; commands recorded after them see the result. Only the change of lamps
    /// that changed is added to the light at the lattice. With `whole` all lamps are summed anew, which removes the
    /// rounding errors of many changes.
    void record_lamp_factors(vk::CommandBuffer commands, std::span<const vec3> factors, uint setting, bool whole);

    const Scene& scene() const { return *scene_; }
    const DescriptorSet& descriptors(uint setting = 0) const { return descriptors_[setting]; }
    /// Specialization constants that depend on scene and map; a pass sets those of the gather itself.
    const FrameConstants& constants() const { return constants_; }
    /// The smallest glTF roughness, 0 to 1, of a surface whose specular lobe rays can follow; 1: there is none.
    float min_lobe() const { return min_lobe_; }
    /// True when the scene has a lobe to follow or glass to look through, so that rays may go on from what a pixel
    /// sees.
    bool may_follow() const { return min_lobe_ < 1 || constants_.follows_through; }
    /// True when rays are traced by the device's ray queries.
    bool queries_rays() const { return queries_rays_; }
    uint triangle_count() const { return triangle_count_; }
    float ray_epsilon() const { return ray_epsilon_; }  // m, as Scene::ray_epsilon()
    float scene_size() const { return scene_size_; }    // m, as Scene::size()
    /// Irradiance at the corners of lattice cells, as the device keeps it for a setting, times this is lux.
    float inverse_irradiance_scale(uint setting = 0) const;
    /// Flux of photons as the device keeps it times this is lm per unit intensity.
    float inverse_flux_scale() const { return inverse_flux_scale_; }
    uint64_t bytes() const;      // GPU memory of all buffers
    uint64_t ray_bytes() const;  // of these, the hierarchy that rays go through

  private:
    void upload_scene(const Scene& scene);
    void upload_corners(const Scene& scene);
    void upload_map(const PhotonMap& map);
    void upload_direct(const Scene& scene, const Bvh& bvh);
    /// Builds the acceleration structure of ray queries. Returns the entries of bvh.triangles in its order: opaque
    /// triangles first, then those that rays may pass.
    std::vector<uint> build_acceleration(const Bvh& bvh);
    /// The lamps at one setting: their powers, and the light at the lattice with these.
    struct Lamps {
        std::vector<vec3> factors;          // per lamp; empty before the first use
        Buffer powers;                      // LampPower, per lamp
        Buffer no_cells;                    // stands for the light at the lattice where the map has none
        std::optional<LampSumSetting> sum;  // where the map has a lattice
    };
    void make_lamps(uint setting);
    // Each uploads an array for all passes, as a buffer of records, as texels of a format, or as texels split over
    // several buffers. `what` names the array in messages.
    template <class T>
    void upload_records(uint binding, std::span<const T> values, const std::string& what);
    template <class T>
    void upload_texels(uint binding, vk::Format format, std::span<const T> values, const std::string& what);
    template <class T>
    void upload_chunks(uint binding, vk::Format format, std::span<const T> values, const std::string& what);

    const Device* device_;
    const Scene* scene_;
    const PhotonMap* map_;
    uint64_t max_texels_;
    FrameConstants constants_;
    uint triangle_count_;
    float inverse_flux_scale_;
    float ray_epsilon_;
    float scene_size_;
    float min_lobe_ = 1;
    bool queries_rays_;
    uint64_t hierarchy_bytes_ = 0;  // of the nodes and triangles of the hierarchy that are in buffers_
    std::array<DescriptorSet, 2> descriptors_;
    std::vector<Buffer> buffers_;
    std::vector<vk::UniqueBufferView> views_;
    std::optional<Acceleration> acceleration_;
    std::optional<LatticeLight> cells_;
    std::optional<LampSum> lamp_sum_;
    std::array<Lamps, 2> lamps_;
};

}  // namespace lw
