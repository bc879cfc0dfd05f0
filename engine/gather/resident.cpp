#include "gather/resident.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "base/error.h"
#include "maps/irradiance.h"

namespace lw {
namespace {

uint descriptor_count(uint binding) {
    if (binding == binding_places) return most_place_chunks;
    return binding == binding_fluxes || binding == binding_directions ? most_flux_chunks : 1u;
}

std::vector<Binding> scene_bindings() {
    const vk::ShaderStageFlags compute = vk::ShaderStageFlagBits::eCompute;
    const auto all = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | compute;
    std::vector<Binding> bindings;
    for (uint i = 0; i < scene_binding_count; ++i)
        bindings.push_back({i, vk::DescriptorType::eStorageBuffer, descriptor_count(i),
                            i <= binding_texels ? vk::ShaderStageFlags(all) : compute});
    return bindings;
}

std::string mebibytes(uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

/// log2 of the records that fit in one buffer.
uint chunk_shift(uint64_t range, uint64_t record_bytes) {
    return std::min(31u, uint(std::bit_width(range / record_bytes)) - 1u);
}

uint chunk_count(uint64_t records, uint shift) {
    return uint(std::max<uint64_t>(1, (records + (1ull << shift) - 1) >> shift));
}

bool any_material(const Scene& scene, uint flags) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& m) { return (m.flags & flags) != 0; });
}

/// Bytes that the map and the scene take on the device.
bool any_texture(const Scene& scene, TextureSlot Material::*slot) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [=](const Material& m) { return (m.*slot).texture >= 0; });
}

bool has_mirrors(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        const bool textured = m.metallic_roughness_texture.texture >= 0;
        return m.metallic > 0.999f && (textured || m.roughness * m.roughness < smallest_alpha);
    });
}

uint64_t total_bytes(const Scene& s, const PhotonMap& m) {
    const auto bytes = [](const auto& v) { return uint64_t(v.size()) * sizeof(v[0]); };
    return bytes(s.positions) + bytes(s.normals) + bytes(s.uv0) + bytes(s.uv1) + bytes(s.colors) + bytes(s.tangents) +
           bytes(s.triangles) + bytes(s.triangle_objects) + bytes(s.texels) + m.bytes();
}

void check_device(const Device& device, const Scene& scene, const PhotonMap& map) {
    const uint32_t needed = scene_binding_count - 3 + most_place_chunks + 2 * most_flux_chunks + 3;
    const uint32_t has = device.limits().maxPerStageDescriptorStorageBuffers;
    if (has < needed)
        throw Error(device.name() + ": binds " + std::to_string(has) + " storage buffers, " + std::to_string(needed) +
                    " are needed");
    const uint64_t bytes = total_bytes(scene, map);
    if (bytes > device.memory_size())
        throw Error(device.name() + ": scene and photons take " + mebibytes(bytes) + ", the device has " +
                    mebibytes(device.memory_size()) + "; bake fewer photons");
}

std::vector<Resident::Cluster> find_clusters(const Scene& scene) {
    const size_t count = (scene.triangles.size() + cluster_triangles - 1) / cluster_triangles;
    std::vector<Resident::Cluster> clusters(count, {vec3(1e30f), vec3(-1e30f)});
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        Resident::Cluster& cluster = clusters[t / cluster_triangles];
        const Material& material = scene.material_of(uint(t));
        cluster.see_through |=
            (material.flags & (material_alpha_mask | material_alpha_blend)) != 0 || material.transmission > 0;
        for (int c = 0; c < 3; ++c) {
            const vec3 p = scene.positions[scene.triangles[t][c]];
            cluster.low = min(cluster.low, p), cluster.high = max(cluster.high, p);
        }
    }
    return clusters;
}

}  // namespace

Resident::Resident(const Device& device, const Scene& scene, const PhotonMap& map, const Bvh& bvh,
                   ResidentSettings settings)
    : device_(&device),
      map_(&map),
      buffer_range_(settings.buffer_range ? settings.buffer_range : device.limits().maxStorageBufferRange),
      triangle_count_(uint(scene.triangles.size())),
      clusters_(find_clusters(scene)),
      max_radius_(map.settings.radius),
      inverse_flux_scale_(1.0f / map.flux_scale),
      ray_epsilon_(scene.ray_epsilon()),
      scene_size_(scene.size()),
      descriptors_(device, scene_bindings()) {
    if (scene.triangles.size() > 0xffffffffu / 3u)
        throw Error(scene.path.string() + ": more than " + std::to_string(0xffffffffu / 3u) + " triangles");
    if (!map.triangle_maps.empty() && map.triangle_maps.size() != 2 * scene.triangles.size())
        throw Error(scene.path.string() + ": the photon map belongs to another scene");
    check_device(device, scene, map);
    choose_constants(scene, map, bvh);
    constants_[constant_has_direct] = !bvh.nodes.empty() && !map.settings.direct_in_photons;
    constants_[constant_has_visible_lamps] = map.has_visible_lamps();
    constants_[constant_has_coverage] = map.has_coverage();
    upload_scene(scene);
    upload_map(map);
    upload_direct(scene, bvh);
    for (const Light& light : scene.lights) lamp_states_.push_back({light, light.intensity, vec3(1)});
    lamps_ = Buffer(device, std::max<size_t>(1, lamp_states_.size()) * sizeof(Lamp), "lights");
    descriptors_.set_buffer(binding_lamps, lamps_);
    set_light_factors(std::vector<vec3>(lamp_states_.size(), vec3(1)));
}

void Resident::choose_constants(const Scene& scene, const PhotonMap& map, const Bvh& bvh) {
    constants_[constant_has_uv0] = !scene.uv0.empty();
    constants_[constant_has_uv1] = !scene.uv1.empty();
    constants_[constant_has_colors] = !scene.colors.empty();
    constants_[constant_has_tangents] = !scene.tangents.empty();
    constants_[constant_has_textures] = !scene.textures.empty();
    constants_[constant_has_directions] = map.has_directions();
    constants_[constant_has_alpha] = any_material(scene, material_alpha_mask | material_alpha_blend);
    constants_[constant_has_transmission] = std::any_of(scene.materials.begin(), scene.materials.end(),
                                                        [](const Material& m) { return m.transmission > 0; });
    constants_[constant_has_mirrors] = !bvh.nodes.empty() && has_mirrors(scene);
    constants_[constant_has_mesh_lamps] = !scene.emitters.empty();
    constants_[constant_has_metallic_roughness_textures] = any_texture(scene, &Material::metallic_roughness_texture);
    constants_[constant_has_emissive_textures] = any_texture(scene, &Material::emissive_texture);
    constants_[constant_has_transmission_textures] = any_texture(scene, &Material::transmission_texture);
    constants_[constant_place_shift] = chunk_shift(buffer_range_, sizeof(PhotonPlace));
    constants_[constant_place_chunks] = chunk_count(map.places.size(), constants_[constant_place_shift]);
    constants_[constant_flux_shift] = chunk_shift(buffer_range_, sizeof(uint));
    constants_[constant_flux_chunks] = chunk_count(map.fluxes.size(), constants_[constant_flux_shift]);
    constants_[constant_heap_size] = 1;
}

void Resident::upload_scene(const Scene& scene) {
    upload_array<vec3>(binding_positions, scene.positions, "positions");
    upload_array<vec3>(binding_normals, scene.normals, "normals");
    upload_array<vec2>(binding_uv0, scene.uv0, "texture coordinates");
    upload_array<vec2>(binding_uv1, scene.uv1, "second texture coordinates");
    upload_array<vec4>(binding_colors, scene.colors, "vertex colours");
    upload_array<vec4>(binding_tangents, scene.tangents, "tangents");
    upload_array<uvec3>(binding_triangles, scene.triangles, "triangles");
    upload_array<uint>(binding_triangle_objects, scene.triangle_objects, "objects of triangles");
    upload_array<Object>(binding_objects, scene.objects, "objects");
    upload_array<Material>(binding_materials, scene.materials, "materials");
    upload_array<Texture>(binding_textures, scene.textures, "textures");
    upload_array<uint>(binding_texels, scene.texels, "texels");
}

void Resident::upload_map(const PhotonMap& map) {
    std::vector<uint> unlit;
    if (map.triangle_maps.empty()) unlit.assign(2 * size_t(triangle_count_), no_map);
    upload_array<uint>(binding_triangle_maps, map.triangle_maps.empty() ? unlit : map.triangle_maps,
                       "maps of triangles");
    upload_array<SurfaceGrid>(binding_grids, map.grids, "grids");
    upload_array<uint>(binding_cell_starts, map.cell_starts, "cells");
    upload_chunks<PhotonPlace>(binding_places, map.places, constants_[constant_place_shift], "photon places");
    upload_chunks<uint>(binding_fluxes, map.fluxes, constants_[constant_flux_shift], "photon fluxes");
    const std::vector<LatticeNode> nodes(map.coverage.size());
    upload_array<LatticeNode>(binding_nodes, nodes, "lattice nodes");
    nodes_ = buffers_.size() - 1;
    upload_array<uint>(binding_visible_lamps, map.visible_lamps, "lamp visibility");
    upload_chunks<uint>(binding_directions, map.directions, constants_[constant_flux_shift], "photon directions");
}

void Resident::upload_direct(const Scene& scene, const Bvh& bvh) {
    upload_array<Emitter>(binding_emitters, scene.emitters, "emitters");
    upload_array<BvhNode>(binding_bvh_nodes, bvh.nodes, "nodes of the shadow rays' hierarchy");
    upload_array<uint>(binding_bvh_triangles, bvh.triangles, "triangles of the shadow rays' hierarchy");
}

template <class T>
void Resident::upload_array(uint binding, std::span<const T> values, const std::string& what) {
    if (values.size_bytes() > device_->limits().maxStorageBufferRange)
        throw Error(device_->name() + ": " + std::to_string(values.size()) + " " + what + " take " +
                    mebibytes(values.size_bytes()) + "; one buffer holds at most " +
                    std::to_string(device_->limits().maxStorageBufferRange / sizeof(T)));
    buffers_.push_back(upload(*device_, values, what));
    descriptors_.set_buffer(binding, buffers_.back());
}

template <class T>
void Resident::upload_chunks(uint binding, std::span<const T> values, uint shift, const std::string& what) {
    const uint most = descriptor_count(binding);
    const size_t chunk = size_t(1) << shift;
    const uint count = chunk_count(values.size(), shift);
    if (count > most)
        throw Error(device_->name() + ": " + std::to_string(values.size()) + " " + what + " do not fit, at most " +
                    std::to_string(most * chunk) + "; bake fewer photons");
    for (uint i = 0; i < count; ++i) {
        const size_t first = std::min(values.size(), i * chunk);
        buffers_.push_back(upload(*device_, values.subspan(first, std::min(chunk, values.size() - first)), what));
        descriptors_.set_buffer(binding, buffers_.back(), i);
    }
    for (uint i = count; i < most; ++i) descriptors_.set_buffer(binding, buffers_.back(), i);  // never read
}

void Resident::set_light_factors(std::span<const float> factors) {
    set_light_factors(std::vector<vec3>(factors.begin(), factors.end()));
}

void Resident::set_light_factors(std::span<const vec3> factors) {
    assert(factors.size() == lamp_states_.size());
    for (size_t i = 0; i < factors.size(); ++i) {
        lamp_states_[i].weight = lamp_states_[i].light.intensity * factors[i];
        lamp_states_[i].factor = factors[i];
    }
    write_nodes();
    write_bytes(*device_, lamps_, lamp_states_.data(), lamp_states_.size() * sizeof(Lamp));
}

void Resident::write_nodes() {
    if (!map_->has_coverage()) return;
    std::vector<vec3> weights;
    for (const Lamp& lamp : lamp_states_) weights.push_back(lamp.weight);
    std::vector<uint> summed;
    inverse_irradiance_scale_ = 1 / sum_irradiance(*map_, weights, summed);
    std::vector<LatticeNode> nodes(summed.size());
    for (size_t n = 0; n < nodes.size(); ++n) nodes[n] = {map_->coverage[n], summed[n]};
    write_bytes(*device_, buffers_[nodes_], nodes.data(), nodes.size() * sizeof(LatticeNode));
}

uint64_t Resident::bytes() const {
    uint64_t sum = lamps_.size();
    for (const Buffer& buffer : buffers_) sum += buffer.size();
    return sum;
}

}  // namespace lw
