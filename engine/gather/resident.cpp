#include "gather/resident.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "base/error.h"
#include "gather/bindings.h"
#include "gather/device_fit.h"
#include "gpu/commands.h"

namespace lw {
namespace {

/// The bindings of the scene's descriptor set: without the acceleration structure where there are no ray queries.
std::vector<Binding> scene_bindings(bool queries_rays) {
    std::vector<Binding> bindings = bindings_of(BindingSet::scene);
    if (!queries_rays) std::erase_if(bindings, [](const Binding& b) { return b.binding == binding_acceleration; });
    return bindings;
}

/// How many buffers of 2^shift records hold so many records; at least 1.
uint chunk_count(uint64_t records, uint shift) {
    return uint(std::max<uint64_t>(1, (records + (1ull << shift) - 1) >> shift));
}

/// The smallest glTF roughness of a material with a specular lobe, 0 where a texture gives it; 1 without any.
float min_roughness(const Scene& scene) {
    float least = 1;
    for (const Material& m : scene.materials)
        if ((m.metallic > 0 || m.specular > 0) && !(m.flags & material_unlit))
            least = std::min(least, m.metallic_roughness_texture.texture >= 0 ? 0.0f : m.roughness);
    return least;
}

}  // namespace

Resident::Resident(const Device& device, const Scene& scene, const PhotonMap& map, const Bvh& bvh,
                   ResidentSettings settings)
    : device_(&device),
      scene_(&scene),
      map_(&map),
      max_texels_(settings.texels ? settings.texels : device.limits().maxTexelBufferElements),
      triangle_count_(uint(scene.triangles.size())),
      inverse_flux_scale_(1.0f / map.flux_scale),
      ray_epsilon_(scene.ray_epsilon()),
      scene_size_(scene.size()),
      queries_rays_(device.ray_queries() && !bvh.nodes.empty()),
      descriptors_{DescriptorSet(device, scene_bindings(queries_rays_)),
                   DescriptorSet(device, scene_bindings(queries_rays_))} {
    if (scene.triangles.size() > 0xffffffffu / 3u)
        throw Error(scene.path.string() + ": more than " + std::to_string(0xffffffffu / 3u) + " triangles");
    if (!map.grid_of_side.empty() && map.grid_of_side.size() != 2 * scene.triangles.size())
        throw Error(scene.path.string() + ": the photon map belongs to another scene");
    check_device(device, scene, map, queries_rays_);
    if (map.has_coverage()) cells_.emplace(scene, map);
    constants_ = constants_of(scene, map, !bvh.nodes.empty());
    constants_.chunk_shift = std::min(27u, uint(std::bit_width(max_texels_)) - 1u);
    constants_.chunks = chunk_count(map.places.size(), constants_.chunk_shift);
    min_lobe_ = bvh.nodes.empty() ? 1.0f : min_roughness(scene);
    upload_scene(scene);
    upload_map(map);
    upload_direct(scene, bvh);
    if (cells_) lamp_sum_.emplace(device, scene, map, *cells_);
    set_lamp_factors(std::vector<vec3>(scene.lights.size(), vec3(1)));
}

/// The records as texels of 16 bytes, `Texels` for each record; what a record leaves of them is 0.
template <uint Texels, class T>
std::vector<uvec4> as_texels(const std::vector<T>& records) {
    std::vector<uvec4> texels(Texels * records.size());
    for (size_t i = 0; i < records.size(); ++i) std::memcpy(&texels[Texels * i], &records[i], sizeof(T));
    return texels;
}

void Resident::upload_scene(const Scene& scene) {
    upload_corners(scene);
    upload_texels<uint>(binding_texels, vk::Format::eR8G8B8A8Unorm, scene.texels, "texels");
    upload_texels<uvec4>(binding_materials, vk::Format::eR32G32B32A32Uint, as_texels<material_texels>(scene.materials),
                         "materials");
    upload_texels<uvec4>(binding_textures, vk::Format::eR32G32B32A32Uint, as_texels<texture_texels>(scene.textures),
                         "textures");
}

/// The values of vertices, three for each triangle in the order of its corners; empty when there are none.
template <class T>
std::vector<T> at_corners(const Scene& scene, const std::vector<T>& values) {
    std::vector<T> corners;
    if (values.empty()) return corners;
    corners.reserve(3 * scene.triangles.size());
    for (const uvec3& t : scene.triangles)
        for (int c = 0; c < 3; ++c) corners.push_back(values[t[c]]);
    return corners;
}

void Resident::upload_corners(const Scene& scene) {
    std::vector<vec4> corners;
    corners.reserve(6 * scene.triangles.size());
    for (const uvec3& t : scene.triangles)
        for (int c = 0; c < 3; ++c) {
            const vec2 uv = scene.uv0.empty() ? vec2(0) : scene.uv0[t[c]];
            corners.emplace_back(scene.positions[t[c]], uv.x);
            corners.emplace_back(scene.normals[t[c]], uv.y);
        }
    upload_texels<vec4>(binding_corners, vk::Format::eR32G32B32A32Sfloat, corners, "corners");
    upload_texels<vec2>(binding_uv1, vk::Format::eR32G32Sfloat, at_corners(scene, scene.uv1),
                        "second texture coordinates");
    upload_texels<vec4>(binding_colors, vk::Format::eR32G32B32A32Sfloat, at_corners(scene, scene.colors),
                        "vertex colours");
    upload_texels<vec4>(binding_tangents, vk::Format::eR32G32B32A32Sfloat, at_corners(scene, scene.tangents),
                        "tangents");
    std::vector<uvec4> triangles;
    triangles.reserve(scene.triangles.size());
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const Object& object = scene.objects[scene.triangle_objects[t]];
        const auto map = [&](size_t side) {
            return map_->grid_of_side.empty() ? no_grid : map_->grid_of_side[2 * t + side];
        };
        triangles.emplace_back(map(0), map(1), object.material, uint(object.light));
    }
    std::vector<uvec2> caustic_grids_of_triangles;
    for (size_t t = 0; t < scene.triangles.size() && map_->caustic_grids > 0; ++t)
        caustic_grids_of_triangles.emplace_back(map_->caustic_grid_of(2 * t), map_->caustic_grid_of(2 * t + 1));
    upload_texels<uvec2>(binding_caustic_grids, vk::Format::eR32G32Uint, caustic_grids_of_triangles,
                         "grids of caustics of triangles");
    upload_texels<uvec4>(binding_triangles, vk::Format::eR32G32B32A32Uint, triangles, "triangles");
}

void Resident::upload_map(const PhotonMap& map) {
    constexpr auto word = vk::Format::eR32Uint, two = vk::Format::eR32G32Uint, four = vk::Format::eR32G32B32A32Uint;
    upload_texels<SurfaceGrid>(binding_grids, four, map.grids, "grids");
    upload_texels<Cut>(binding_cuts, four, map.cuts, "cuts");
    upload_texels<uint>(binding_cell_starts, word, map.cell_starts, "cells");
    upload_chunks<PhotonPlace>(binding_places, two, map.places, "photon places");
    upload_chunks<uint>(binding_fluxes, word, map.fluxes, "photon fluxes");
    upload_chunks<uint16_t>(binding_directions, vk::Format::eR16Uint, map.directions, "photon directions");
    upload_texels<uint>(binding_coverage, word, map.coverage, "coverage");
    upload_texels<uint>(binding_lattice_rows, word, cells_ ? cells_->rows() : std::vector<uint>(), "cells");
    upload_texels<uvec4>(binding_shadow_masks, four, cells_ ? cells_->masks() : std::vector<uvec4>(), "shadow masks");
}

void Resident::upload_direct(const Scene& scene, const Bvh& bvh) {
    upload_records<Light>(binding_lights, scene.lights, "lights");
    upload_records<Emitter>(binding_emitters, scene.emitters, "emitters");
    const std::span<const BvhNode> nodes = queries_rays_ ? std::span<const BvhNode>() : bvh.nodes;
    const std::vector<uint> triangles = queries_rays_ ? build_acceleration(bvh) : bvh.triangles;
    upload_texels<BvhNode>(binding_bvh_nodes, vk::Format::eR32G32B32A32Uint, nodes,
                           "nodes of the shadow rays' hierarchy");
    upload_texels<uint>(binding_bvh_triangles, vk::Format::eR32Uint, triangles,
                        "triangles of the shadow rays' hierarchy");
    hierarchy_bytes_ = nodes.size_bytes() + triangles.size() * sizeof(uint);
}

std::vector<uint> Resident::build_acceleration(const Bvh& bvh) {
    std::vector<uint> entries = bvh.triangles;
    const auto others = std::stable_partition(entries.begin(), entries.end(),
                                              [](uint entry) { return (entry & bvh_see_through) == 0; });
    std::vector<uvec3> corners;
    corners.reserve(entries.size());
    for (uint entry : entries) corners.push_back(scene_->triangles[entry & ~bvh_see_through]);
    const auto opaque = size_t(others - entries.begin());
    constants_.first_see_through = opaque < entries.size() ? uint(opaque) : no_triangle;
    acceleration_.emplace(*device_, TracedTriangles{scene_->positions, corners, opaque});
    for (const DescriptorSet& set : descriptors_) set.set_acceleration(binding_acceleration, acceleration_->handle());
    return entries;
}

template <class T>
void Resident::upload_records(uint binding, std::span<const T> values, const std::string& what) {
    const uint64_t most = device_->limits().maxStorageBufferRange / sizeof(T);
    if (values.size() > most)
        throw Error(device_->name() + ": " + std::to_string(values.size()) + " " + what +
                    ", one buffer holds at most " + std::to_string(most));
    buffers_.push_back(upload(*device_, values, what));
    for (const DescriptorSet& set : descriptors_) set.set_buffer(binding, buffers_.back());
}

/// The size of a texel of one of the formats used here.
uint texel_bytes(vk::Format format) {
    switch (format) {
        case vk::Format::eR16Uint:
            return 2;
        case vk::Format::eR32G32Uint:
        case vk::Format::eR32G32Sfloat:
            return 8;
        case vk::Format::eR32G32B32A32Uint:
        case vk::Format::eR32G32B32A32Sfloat:
            return 16;
        default:
            return 4;
    }
}

template <class T>
void Resident::upload_texels(uint binding, vk::Format format, std::span<const T> values, const std::string& what) {
    if (values.size_bytes() / texel_bytes(format) > device_->limits().maxTexelBufferElements)
        throw Error(device_->name() + ": " + std::to_string(values.size()) + " " + what + " take " +
                    mebibytes(values.size_bytes()) + "; one buffer holds at most " +
                    mebibytes(uint64_t(device_->limits().maxTexelBufferElements) * texel_bytes(format)));
    buffers_.push_back(upload(*device_, values, what));
    views_.push_back(view_as_texels(*device_, buffers_.back(), format));
    for (const DescriptorSet& set : descriptors_) set.set_texels(binding, *views_.back());
}

template <class T>
void Resident::upload_chunks(uint binding, vk::Format format, std::span<const T> values, const std::string& what) {
    const uint shift = constants_.chunk_shift, count = chunk_count(values.size(), shift);
    const size_t chunk = size_t(1) << shift;
    if (count > max_chunks)
        throw Error(device_->name() + ": " + std::to_string(values.size()) + " " + what + " do not fit, at most " +
                    std::to_string(max_chunks * chunk) + "; bake fewer photons");
    for (uint i = 0; i < count; ++i) {
        const size_t first = std::min(values.size(), i * chunk);
        buffers_.push_back(upload(*device_, values.subspan(first, std::min(chunk, values.size() - first)), what));
        views_.push_back(view_as_texels(*device_, buffers_.back(), format));
        for (const DescriptorSet& set : descriptors_) set.set_texels(binding, *views_.back(), i);
    }
    for (const DescriptorSet& set : descriptors_)
        for (uint i = count; i < max_chunks; ++i) set.set_texels(binding, *views_.back(), i);  // never read
}

void Resident::set_lamp_factors(std::span<const float> factors, uint setting) {
    set_lamp_factors(std::vector<vec3>(factors.begin(), factors.end()), setting);
}

void Resident::set_lamp_factors(std::span<const vec3> factors, uint setting) {
    submit_and_wait(*device_,
                    [&](vk::CommandBuffer commands) { record_lamp_factors(commands, factors, setting, true); });
}

void Resident::record_lamp_factors(vk::CommandBuffer commands, std::span<const vec3> factors, uint setting,
                                   bool whole) {
    assert(factors.size() == scene_->lights.size());
    Lamps& lamps = lamps_[setting];
    if (lamps.powers.size() == 0) make_lamps(setting);
    std::vector<vec3> powers;
    for (size_t i = 0; i < factors.size(); ++i) powers.push_back(scene_->lights[i].intensity * factors[i]);
    if (lamps.sum) lamp_sum_->record(commands, *lamps.sum, powers, whole);
    if (std::equal(factors.begin(), factors.end(), lamps.factors.begin(), lamps.factors.end())) return;
    lamps.factors.assign(factors.begin(), factors.end());
    std::vector<LampPower> records;
    for (size_t i = 0; i < factors.size(); ++i) records.push_back({vec4(powers[i], 0), vec4(factors[i], 0)});
    record_update(commands, lamps.powers, std::span<const LampPower>(records));
}

void Resident::make_lamps(uint setting) {
    Lamps& lamps = lamps_[setting];
    const size_t lights = std::max<size_t>(1, scene_->lights.size());
    lamps.powers = Buffer(*device_, lights * sizeof(LampPower), "powers of lamps");
    if (lamp_sum_)
        lamps.sum = lamp_sum_->make_setting();
    else
        lamps.no_cells = upload(*device_, std::span<const uvec4>(), "light of cells");
    views_.push_back(view_as_texels(*device_, lamps.powers, vk::Format::eR32G32B32A32Sfloat));
    descriptors_[setting].set_texels(binding_lamp_powers, *views_.back());
    const Buffer& cells = lamps.sum ? lamps.sum->cells : lamps.no_cells;
    views_.push_back(view_as_texels(*device_, cells, vk::Format::eR32G32B32A32Uint));
    descriptors_[setting].set_texels(binding_lattice_light, *views_.back());
}

float Resident::inverse_irradiance_scale(uint setting) const {
    const Lamps& lamps = lamps_[setting];
    return lamps.sum ? 1 / lamp_sum_->record_scale(*lamps.sum) : 1.0f;
}

uint64_t Resident::ray_bytes() const {
    return acceleration_ ? acceleration_->bytes() + hierarchy_bytes_ : hierarchy_bytes_;
}

uint64_t Resident::bytes() const {
    uint64_t sum = 0;
    for (const Buffer& buffer : buffers_) sum += buffer.size();
    if (acceleration_) sum += acceleration_->bytes();
    if (lamp_sum_) sum += lamp_sum_->bytes();
    for (const Lamps& lamps : lamps_) sum += lamps.powers.size() + (lamps.sum ? lamps.sum->bytes() : 0);
    return sum;
}

}  // namespace lw
