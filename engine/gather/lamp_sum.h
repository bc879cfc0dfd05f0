// The light of all lamps at the lattice, summed on the device: passes recorded with a frame, so that dimming neither
// stages nor waits (shaders/sum_nodes.comp, sum_cells.comp).
#pragma once
#include <optional>
#include <span>

#include "gpu/pipeline.h"
#include "maps/lattice_light.h"
#include "scene/scene.h"
#include "shaders/lamp_sum.h"

namespace lw {

/// What the lamps give at one setting of their powers.
struct LampSumSetting {
    std::vector<vec3> powers;  // summed so far, one per lamp; empty: none yet
    float total = 0;           // of the powers when all were summed last
    float scale = 0;           // of the sums, from then
    bool is_whole = false;     // no lamp was added since
    Buffer terms, node_sums, cell_direct, cells;
    vk::UniqueBufferView node_texels;
    std::optional<DescriptorSet> descriptors;

    uint64_t bytes() const { return terms.size() + node_sums.size() + cell_direct.size() + cells.size(); }
};

class LampSum {
  public:
    /// Uploads irradiance and direct light of the lamps, sparse. Device, scene, map and cells must outlive it; `cells`
    /// are those of scene and map. Throws Error when they do not fit.
    LampSum(const Device& device, const Scene& scene, const PhotonMap& map, const LatticeLight& cells);

    /// Buffers for one setting; its cells are what the gather reads as lattice_light.
    LampSumSetting make_setting() const;

    /// Records the sum at these powers (one RGB power per lamp) into the cells of a setting. Lamps that changed are
    /// added, unless `whole` is asked for, there are no sums yet, half of the lamps or more have changed, or the
    /// brightness has changed so much that the scale of the sums must change. Later commands see the result. Records
    /// nothing when nothing has changed.
    void record(vk::CommandBuffer commands, LampSumSetting& setting, std::span<const vec3> powers, bool whole);

    /// Texels of the setting's cells hold lux x this.
    float record_scale(const LampSumSetting& setting) const { return setting.scale * map_->irradiance_scale; }
    uint64_t bytes() const;

  private:
    std::vector<LampTerm> terms_of(const LampSumSetting& setting, std::span<const vec3> powers, bool whole) const;
    void keep_direct(LampSumSetting& setting) const;
    /// True when the change of a lamp can be added.
    bool keeps_all(const LampSumSetting& setting) const;
    void dispatch(vk::CommandBuffer commands, const LampSumSetting& setting, LampSumPush push) const;
    void upload_texels(uint binding, vk::Format format, Buffer buffer);

    const Device* device_;
    const Scene* scene_;
    const PhotonMap* map_;
    const LatticeLight* cells_;
    uint nodes_;
    std::vector<uint> punctual_;  // of each lamp: its place among LatticeLight::punctual(), or no_place
    std::vector<std::pair<uint, vk::UniqueBufferView>> shared_;  // binding and texels
    std::vector<Buffer> buffers_;
    DescriptorSet shape_;  // never bound: the layout of the settings' sets
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline nodes_pass_, cells_pass_;
};

}  // namespace lw
