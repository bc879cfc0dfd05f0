// A scene and its photon map in GPU memory, as descriptor set 0 of all passes (shaders/frame.h).
// The photons' arrays are uploaded as they are, those of the vertices per corner; photon records beyond the device's
// texel buffers are split over several.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "gather/constants.h"
#include "gpu/acceleration.h"
#include "gpu/pipeline.h"
#include "maps/cells.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "shaders/frame.h"

namespace lw {

struct ResidentSettings {
    uint64_t texels = 0;  // most records of one buffer; 0: what the device allows. For tests of the splitting.
};

class Resident {
  public:
    /// Uploads everything; all lights at factor 1. Scene and map must outlive it; one without grid_of_side means no
    /// photons. Without `bvh` no rays are traced: no shadow rays, mirrors are black, glass is looked
    /// straight through. Throws Error saying which
    /// array does not fit, and what would.
    Resident(const Device& device, const Scene& scene, const PhotonMap& map, const Bvh& bvh = {},
             ResidentSettings settings = {});
    Resident(const Device&, const Scene&, PhotonMap&&, const Bvh& = {},
             ResidentSettings = {}) = delete;  // would not outlive it

    /// Dims the lights: one factor per light of the scene, >= 0, or one per channel. Setting 0 or 1: two of them lie on
    /// the device, so that one frame can show both; the second takes memory from its first use on. The same factors
    /// again cost nothing.
    void set_light_factors(std::span<const float> factors, uint setting = 0);
    void set_light_factors(std::span<const vec3> factors, uint setting = 0);

    const Scene& scene() const { return *scene_; }
    const DescriptorSet& descriptors(uint setting = 0) const { return descriptors_[setting]; }
    /// Specialization constants of the scene; those of the gather are left to the pass.
    const FrameConstants& constants() const { return constants_; }
    /// The least roughness of a surface whose lobe could be followed by rays; 1: there is none.
    float min_lobe() const { return min_lobe_; }
    /// True when view paths may go on from what the eye sees.
    bool may_follow() const { return min_lobe_ < 1 || constants_.looks_through; }
    /// True when rays are traced by the device's ray queries.
    bool queries_rays() const { return queries_rays_; }
    uint triangle_count() const { return triangle_count_; }
    float max_radius() const { return max_radius_; }    // m
    float ray_epsilon() const { return ray_epsilon_; }  // m
    float scene_size() const { return scene_size_; }    // m
    float inverse_irradiance_scale(uint setting = 0) const { return lamps_[setting].inverse_irradiance_scale; }
    float inverse_flux_scale() const { return inverse_flux_scale_; }
    uint64_t bytes() const;      // GPU memory of all buffers
    uint64_t ray_bytes() const;  // of these, what rays are found with

  private:
    void choose_constants(const Scene& scene, const PhotonMap& map, const Bvh& bvh);
    void upload_scene(const Scene& scene);
    void upload_corners(const Scene& scene);
    void upload_map(const PhotonMap& map);
    void upload_direct(const Scene& scene, const Bvh& bvh);
    /// Builds what ray queries meet; its triangles, opaque ones first.
    std::vector<uint> queried(const Bvh& bvh);
    /// The lamps at one setting: their powers, and the light of the cells at these.
    struct Lamps {
        std::vector<vec3> factors;
        Buffer powers, cells;
        float inverse_irradiance_scale = 1;
    };
    void make_lamps(uint setting);
    void write_cells(Lamps& lamps, std::span<const vec3> weights) const;
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
    float max_radius_;
    float inverse_flux_scale_;
    float ray_epsilon_;
    float scene_size_;
    float min_lobe_ = 1;
    bool queries_rays_;
    uint64_t list_of_rays_ = 0;  // bytes of nodes and triangles in buffers_
    std::array<DescriptorSet, 2> descriptors_;
    std::vector<Buffer> buffers_;
    std::vector<vk::UniqueBufferView> views_;
    std::optional<Acceleration> acceleration_;
    std::optional<CellLight> cells_;
    std::array<Lamps, 2> lamps_;
};

}  // namespace lw
