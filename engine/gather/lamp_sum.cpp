#include "gather/lamp_sum.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"
#include "gather/bindings.h"
#include "gather/device_fit.h"
#include "gpu/commands.h"
#include "sum_cells.comp.spv.h"
#include "sum_nodes.comp.spv.h"

namespace lw {
namespace {

using Stage = vk::PipelineStageFlagBits2;
constexpr uint64_t bytes_of_cell_direct = 4 * sizeof(vec3);
constexpr float max_brightening = 8;      // RGB9E5 has room for sixteen times the brightest record
constexpr float max_dimming = 1.0f / 64;  // and keeps its nine bits over 28 powers of two

/// Columns of the lattice at each node that begins a cell, 0 at the others.
std::vector<uint> columns_of(const PhotonMap& map) {
    std::vector<uint> columns(map.coverage.size(), 0);
    for (const SurfaceGrid& grid : map.grids) {
        const SurfaceLattice& lattice = grid.lattice;
        for (uint y = 0; y + 1 < lattice.rows; ++y)
            for (uint x = 0; x + 1 < lattice.columns; ++x)
                columns[lattice.first_node + y * lattice.columns + x] = lattice.columns;
    }
    return columns;
}

/// Bytes of a buffer of `bytes` a node, in whole windows where there is more than one.
uint64_t bytes_in_windows(uint nodes, uint64_t bytes) {
    const uint64_t windows = (nodes + uint64_t(lamp_sum_window) - 1) / lamp_sum_window;
    return bytes * (windows > 1 ? windows * lamp_sum_window : std::max(nodes, 1u));
}

void set_window(const LampSumSetting& setting, uint binding, const Buffer& buffer, uint nodes, uint64_t bytes) {
    setting.descriptors->set_window(binding, buffer, bytes * std::min(std::max(nodes, 1u), lamp_sum_window));
}

/// Lamps whose power is another than in the sums.
size_t changed(const LampSumSetting& setting, std::span<const vec3> powers) {
    size_t count = 0;
    for (size_t i = 0; i < powers.size(); ++i) count += powers[i] != setting.powers[i];
    return count;
}

float total_of(std::span<const vec3> powers) {
    float total = 0;
    for (const vec3& p : powers) total += std::max({p.x, p.y, p.z});
    return total;
}

}  // namespace

LampSum::LampSum(const Device& device, const Scene& scene, const PhotonMap& map, const LatticeLight& cells)
    : device_(&device),
      scene_(&scene),
      map_(&map),
      cells_(&cells),
      nodes_(uint(map.coverage.size())),
      punctual_(scene.lights.size(), no_place),
      shape_(device, bindings_of(BindingSet::lamp_sum)) {
    for (size_t i = 0; i < cells.punctual().size(); ++i) punctual_[cells.punctual()[i]] = uint(i);
    constexpr auto word = vk::Format::eR32Uint, two = vk::Format::eR32G32Uint;
    const auto add = [&](uint binding, vk::Format format, const auto& values, const char* what) {
        using Value = std::remove_cvref_t<decltype(values[0])>;
        upload_texels(binding, format, upload(device, std::span<const Value>(values), what));
    };
    add(binding_irradiance_marks, two, map.irradiance.marks_and_starts(), "irradiance of lamps");
    add(binding_irradiance_values, word, map.irradiance.values, "irradiance of lamps");
    add(binding_direct_marks, two, cells.direct().marks_and_starts(), "direct light of lamps");
    add(binding_direct_values, word, cells.direct().values, "direct light of lamps");
    add(binding_lattice_columns, word, columns_of(map), "lattice");
    add(binding_sum_lattice_rows, word, cells.rows(), "cells");
    const vk::DescriptorSetLayout sets[] = {shape_.layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(LampSumPush));
    nodes_pass_ = make_compute_pipeline(device, *layout_, sum_nodes_comp, {});
    cells_pass_ = make_compute_pipeline(device, *layout_, sum_cells_comp, {});
}

void LampSum::upload_texels(uint binding, vk::Format format, Buffer buffer) {
    const uint64_t texel = format == vk::Format::eR32G32Uint ? 8 : 4, most = device_->limits().maxTexelBufferElements;
    if (buffer.size() / texel > most)
        throw Error(device_->name() + ": the light of the lamps takes " + mebibytes(buffer.size()) +
                    ", one buffer holds at most " + mebibytes(most * texel) + "; bake fewer photons");
    buffers_.push_back(std::move(buffer));
    shared_.emplace_back(binding, view_as_texels(*device_, buffers_.back(), format));
}

LampSumSetting LampSum::make_setting() const {
    LampSumSetting setting;
    setting.terms = Buffer(*device_, std::max<size_t>(1, scene_->lights.size()) * sizeof(LampTerm), "powers of lamps");
    setting.node_sums = Buffer(*device_, bytes_in_windows(nodes_, sizeof(vec4)), "light of nodes");
    setting.cells = Buffer(*device_, bytes_in_windows(nodes_, sizeof(uvec4)), "light of cells");
    setting.node_texels = view_as_texels(*device_, setting.node_sums, vk::Format::eR32G32B32A32Sfloat);
    setting.descriptors.emplace(*device_, bindings_of(BindingSet::lamp_sum));
    for (const auto& [binding, texels] : shared_) setting.descriptors->set_texels(binding, *texels);
    setting.descriptors->set_buffer(binding_lamp_terms, setting.terms);
    setting.descriptors->set_texels(binding_node_sum_texels, *setting.node_texels);
    set_window(setting, binding_node_sums, setting.node_sums, nodes_, sizeof(vec4));
    set_window(setting, binding_cell_sums, setting.cells, nodes_, sizeof(uvec4));
    set_window(setting, binding_cell_direct, setting.cells, nodes_, sizeof(uvec4));  // not read until there is one
    return setting;
}

/// Makes room for what cells hold of the lamps' own light, unless they hold none. Where there is no memory for it, all
/// lamps are summed at each change.
void LampSum::keep_direct(LampSumSetting& setting) const {
    const uint64_t bytes = bytes_in_windows(nodes_, bytes_of_cell_direct);
    const bool fits = bytes < uint64_t(1) << 32 && bytes <= device_->memory_budget(bytes);  // offsets have 32 bits
    if (keeps_all(setting) || !fits) return;
    device_->handle().waitIdle();  // once: frames before use the descriptors
    setting.cell_direct = Buffer(*device_, bytes, "light of lamps in cells");
    set_window(setting, binding_cell_direct, setting.cell_direct, nodes_, bytes_of_cell_direct);
}

bool LampSum::keeps_all(const LampSumSetting& setting) const {
    return setting.cell_direct.size() > 0 || cells_->direct().values.empty();
}

std::vector<LampTerm> LampSum::terms_of(const LampSumSetting& setting, std::span<const vec3> powers, bool whole) const {
    std::vector<LampTerm> terms;
    for (uint lamp = 0; lamp < powers.size(); ++lamp) {
        const vec3 power = whole ? powers[lamp] : powers[lamp] - setting.powers[lamp];
        if (whole || power != vec3(0)) terms.push_back({power * setting.scale, lamp, power, punctual_[lamp]});
    }
    return terms;
}

void LampSum::record(vk::CommandBuffer commands, LampSumSetting& setting, std::span<const vec3> powers, bool whole) {
    assert(powers.size() == scene_->lights.size());
    const bool same = std::equal(powers.begin(), powers.end(), setting.powers.begin(), setting.powers.end());
    if (same && (setting.is_whole || !whole)) return;
    const float total = total_of(powers);
    const bool in_range = total <= max_brightening * setting.total && total >= max_dimming * setting.total;
    const bool few_change = !setting.powers.empty() && !same && 2 * changed(setting, powers) < powers.size();
    whole = whole || !few_change || !in_range || !keeps_all(setting);
    if (few_change) keep_direct(setting);  // the next change is added
    if (whole) setting.total = total, setting.scale = cells_->scale_of(powers);
    const std::vector<LampTerm> terms = terms_of(setting, powers, whole);
    record_update(commands, setting.terms, std::span<const LampTerm>(terms));  // after the frame before
    LampSumPush push{};
    push.nodes = nodes_;
    push.terms = uint(terms.size());
    push.adds = whole ? 0 : 1;
    push.keeps_direct = setting.cell_direct.size() > 0;
    push.row_length = lattice_row_length(uint(powers.size()), map_->has_marks());
    push.first_lamp_column = map_->has_marks() ? 1 : 0;
    push.record_scale = record_scale(setting);
    dispatch(commands, setting, push);
    setting.powers.assign(powers.begin(), powers.end());
    setting.is_whole = whole;
}

void LampSum::dispatch(vk::CommandBuffer commands, const LampSumSetting& setting, LampSumPush push) const {
    const auto compute = vk::PipelineBindPoint::eCompute;
    for (const vk::Pipeline pass : {*nodes_pass_, *cells_pass_}) {
        commands.bindPipeline(compute, pass);
        for (push.first = 0; push.first < nodes_; push.first = push.end) {
            push.end = push.first + std::min(nodes_ - push.first, lamp_sum_window);
            const uint direct = setting.cell_direct.size() > 0 ? push.first * uint(bytes_of_cell_direct) : 0;
            const uint offsets[] = {push.first * uint(sizeof(vec4)), direct, push.first * uint(sizeof(uvec4))};
            commands.bindDescriptorSets(compute, *layout_, 0, setting.descriptors->handle(), offsets);
            commands.pushConstants<LampSumPush>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, push);
            commands.dispatch((push.end - push.first + lamp_sum_group - 1) / lamp_sum_group, 1, 1);
        }
        stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader);
    }
}

uint64_t LampSum::bytes() const {
    uint64_t sum = 0;
    for (const Buffer& buffer : buffers_) sum += buffer.size();
    return sum;
}

}  // namespace lw
