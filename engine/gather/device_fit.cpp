#include "gather/device_fit.h"

#include <algorithm>

#include "base/error.h"
#include "base/memory.h"
#include "gather/bindings.h"
#include "shaders/cull.h"
#include "shaders/followed.h"
#include "shaders/frame.h"

namespace lw {

std::string mebibytes(uint64_t bytes) {
    if (bytes < 1u << 20) return std::to_string((bytes + 1023) >> 10) + " KiB";
    return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB";
}

namespace {

/// Bytes of the list of triangles to draw and of the buffers of culling.
uint64_t list_bytes(const Scene& scene) {
    const uint64_t clusters = (scene.triangles.size() + cluster_triangles - 1) / cluster_triangles;
    return clusters * (sizeof(Cluster) + blocks_per_cluster * sizeof(Survivors) + cluster_triangles * sizeof(uint));
}

/// Bytes that the scene and the map take on the device: corners of triangles, textures, the map with the sums of
/// its lamps.
uint64_t total_bytes(const Scene& s, const PhotonMap& m, bool queries_rays) {
    const auto bytes = [](const auto& v) { return uint64_t(v.size()) * sizeof(v[0]); };
    // For an acceleration structure and its build; on Mesa's software rasterizer 70 bytes remain after the build.
    const uint64_t rays_per_triangle = queries_rays ? 200 : 0;
    const uint64_t corner = 32 + (s.uv1.empty() ? 0 : 8) + (s.colors.empty() ? 0 : 16) + (s.tangents.empty() ? 0 : 16);
    return s.triangles.size() * (3 * corner + sizeof(uvec4) + rays_per_triangle) + list_bytes(s) + bytes(s.texels) +
           m.bytes() +
           m.coverage.size() * (sizeof(uvec4) + sizeof(vec4) + sizeof(uint) +
                                lattice_row_length(uint(s.lights.size()), m.has_marks()) * sizeof(uint));
}

/// The number of photons, to one significant digit, of a map that fits into the budget beside `others` bytes. Assumes
/// that the map's size is proportional to its photons.
uint64_t photons_that_fit(const PhotonMap& map, uint64_t others, uint64_t budget) {
    if (others >= budget) return 0;
    const double share = double(budget - others) / double(std::max<uint64_t>(map.bytes(), 1));
    const auto most = uint64_t(double(map.settings.photons) * std::min(share, 1.0));
    uint64_t step = 1;
    while (most / step >= 10) step *= 10;
    return most / step * step;
}

/// The number of descriptors of a set that count as sampled images; texel buffers do.
uint32_t sampled_images(BindingSet set) {
    uint32_t count = 0;
    for (const Binding& b : bindings_of(set))
        if (b.type == vk::DescriptorType::eUniformTexelBuffer || b.type == vk::DescriptorType::eSampledImage)
            count += b.count;
    return count;
}

}  // namespace

void check_device(const Device& device, const Scene& scene, const PhotonMap& map, bool queries_rays) {
    const uint32_t needed = sampled_images(BindingSet::scene) + sampled_images(BindingSet::picture);
    const uint32_t has = device.limits().maxPerStageDescriptorSampledImages;
    if (has < needed)
        throw Error(device.name() + ": binds " + std::to_string(has) + " textures, " + std::to_string(needed) +
                    " are needed");
    const uint64_t bytes = total_bytes(scene, map, queries_rays), budget = device.memory_budget();
    if (bytes <= budget) return;
    const uint64_t without_photons = bytes - std::min(bytes, map.bytes()),
                   most = photons_that_fit(map, without_photons, budget);
    throw Error(
        device.name() + ": scene and photons take " + mebibytes(bytes) + ", " + mebibytes(budget) +
        " may be used (--device-memory)" +
        (most ? "; a map of " + std::to_string(most) + " photons would fit" : "; the scene alone does not fit"));
}

vk::Extent2D fit_pictures(const Device& device, const Resident& resident, vk::Extent2D size, uint pictures) {
    constexpr uint64_t seen = sizeof(uvec4) + sizeof(float);  // visibility and depth of a pixel
    constexpr uint64_t read_back = 100;  // per pixel: nine channels and the buffers they are made from
    const uint lists = pixel_lists(uint(resident.scene().lights.size()), resident.may_follow());
    const uint64_t light = sizeof(vec4) + lists * sizeof(uint) + 4 + (resident.may_follow() ? sizeof(Followed) : 0);
    try {
        check_picture_fits(size.width, size.height, seen + pictures * light, device.memory_budget(resident.bytes()));
    } catch (const Error& failure) {
        throw Error(device.name() + " (--device-memory): " + failure.what());
    }
    check_picture_fits(size.width, size.height, read_back, available_memory());
    return size;
}

}  // namespace lw
