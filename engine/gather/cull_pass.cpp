#include "gather/cull_pass.h"

#include <algorithm>

#include "compact.comp.spv.h"
#include "cull.comp.spv.h"
#include "gather/bindings.h"
#include "gpu/commands.h"
#include "scan.comp.spv.h"

namespace lw {
namespace {

using Stage = vk::PipelineStageFlagBits2;

Cluster make_cluster(const Scene& scene, uint first) {
    const auto count = uint(scene.triangles.size());
    Cluster cluster{vec3(1e30f), first, vec3(-1e30f), std::min(first + cluster_triangles, count)};
    for (uint t = first; t < cluster.end; ++t)
        for (int c = 0; c < 3; ++c) {
            const vec3 p = scene.positions[scene.triangles[t][c]];
            cluster.low = min(cluster.low, p), cluster.high = max(cluster.high, p);
        }
    return cluster;
}

/// True when any triangle of the cluster is alpha-masked, blended or transmissive.
bool is_see_through(const Scene& scene, const Cluster& cluster) {
    for (uint t = cluster.first; t < cluster.end; ++t) {
        const Material& m = scene.material_of(t);
        if ((m.flags & (material_alpha_mask | material_alpha_blend)) != 0 || m.transmission > 0) return true;
    }
    return false;
}

/// All clusters: opaque ones, then see-through ones, each in the scene's order.
struct Clusters {
    std::vector<Cluster> clusters;
    uint opaque;
};

Clusters find_clusters(const Scene& scene) {
    std::vector<Cluster> opaque, others;
    for (size_t t = 0; t < scene.triangles.size(); t += cluster_triangles) {
        const Cluster cluster = make_cluster(scene, uint(t));
        (is_see_through(scene, cluster) ? others : opaque).push_back(cluster);
    }
    const auto count = uint(opaque.size());
    opaque.insert(opaque.end(), others.begin(), others.end());
    return {std::move(opaque), count};
}

/// The list for a draw without culling: all triangles, with no_triangle at the end of clusters that are not full.
std::vector<uint> list_all(const std::vector<Cluster>& clusters) {
    std::vector<uint> listed;
    listed.reserve(clusters.size() * cluster_triangles);
    for (const Cluster& cluster : clusters)
        for (uint i = 0; i < cluster_triangles; ++i)
            listed.push_back(cluster.first + i < cluster.end ? cluster.first + i : no_triangle);
    return listed;
}

/// How far, in pixels, the rasterizer may move a corner: half a step of its subpixels, and as much again, at least
/// 1/512, for rounding in the projection.
float pixel_margin(const Device& device) {
    return 1.0f / float(1u << std::min(device.limits().subPixelPrecisionBits, 8u));
}

}  // namespace

CullPass::CullPass(const Device& device, const Resident& resident, size_t culled_from)
    : device_(&device),
      resident_(&resident),
      culls_(resident.triangle_count() >= std::max<size_t>(1, culled_from)),
      descriptors_(device, bindings_of(BindingSet::cull)) {
    const auto [clusters, opaque] = find_clusters(resident.scene());
    const auto count = uint(clusters.size());
    blocks_ = blocks_per_cluster * count;
    first_see_through_ = cluster_triangles * opaque;
    const DrawArguments whole[] = {{3 * cluster_triangles, opaque, 0, 0},
                                   {3 * cluster_triangles, count - opaque, 0, 0}};
    clusters_ = upload<Cluster>(device, clusters, "clusters of triangles");
    survivors_ = upload<Survivors>(device, std::vector<Survivors>(blocks_), "triangles in view");
    draws_ = upload<DrawArguments>(device, whole, "draws");
    listed_ = upload<uint>(device, list_all(clusters), "listed triangles");
    cluster_texels_ = view_as_texels(device, clusters_, vk::Format::eR32G32B32A32Uint);
    listed_texels_ = view_as_texels(device, listed_, vk::Format::eR32Uint);
    descriptors_.set_texels(binding_clusters, *cluster_texels_);
    descriptors_.set_buffer(binding_survivors, survivors_);
    descriptors_.set_buffer(binding_draws, draws_);
    descriptors_.set_buffer(binding_listed, listed_);
    descriptors_.set_texels(binding_listed_texels, *listed_texels_);
    if (culls_) make_pipelines();
}

void CullPass::make_pipelines() {
    const Device& device = *device_;
    const vk::DescriptorSetLayout sets[] = {resident_->descriptors().layout(), descriptors_.layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(Frame));
    FrameConstants constants = resident_->constants();
    constants.first_listed = first_see_through_;
    constants.pixel_margin = pixel_margin(device);
    cull_ = make_compute_pipeline(device, *layout_, cull_comp, spec_constants_of(constants));
    scan_ = make_compute_pipeline(device, *layout_, scan_comp, spec_constants_of(constants));
    compact_ = make_compute_pipeline(device, *layout_, compact_comp, spec_constants_of(constants));
}

void CullPass::record(vk::CommandBuffer commands, const Frame& frame) const {
    if (!culls_) return;
    const vk::DescriptorSet sets[] = {resident_->descriptors().handle(), descriptors_.handle()};
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets, {});
    commands.pushConstants<Frame>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, frame);
    const auto dispatch = [&](vk::Pipeline pipeline, uint groups) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
        commands.dispatch(groups, 1, 1);
    };
    const uint groups = (blocks_ + cull_group - 1) / cull_group;
    const auto draws = Stage::eDrawIndirect | Stage::eVertexShader;
    stage_barrier(commands, draws | Stage::eComputeShader, Stage::eComputeShader);  // the frame before may still draw
    dispatch(*cull_, groups);
    stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader);
    dispatch(*scan_, 1);
    stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader);
    dispatch(*compact_, groups);
    stage_barrier(commands, Stage::eComputeShader, draws);
}

void CullPass::draw(vk::CommandBuffer commands, bool see_through) const {
    commands.drawIndirect(draws_.handle(), see_through * sizeof(DrawArguments), 1, sizeof(DrawArguments));
}

}  // namespace lw
