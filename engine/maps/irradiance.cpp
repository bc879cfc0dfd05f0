#include "maps/irradiance.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "maps/mesh_light.h"
#include "maps/packing.h"
#include "maps/photon_estimate.h"
#include "maps/smooth_caustics.h"
#include "maps/smoothing.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr float max_record = 4096;

void add_to(std::span<vec3> light, std::span<const vec3> more) {
    parallel_for(
        more.size(), [&](size_t i) { light[i] += more[i]; }, 4096);
}

/// Replaces what the photons of a lamp say at the nodes by what rays from the nodes see, and adds the lamp's direct
/// light if it has a surface.
void gather_lamp(const GatherInput& input, uint lamp, std::span<const vec3> caustics, Progress& progress,
                 std::span<vec3> light) {
    const bool has_direct = !is_delta(input.scene.lights[lamp].type);
    std::vector<vec3> direct, seen(light.begin(), light.end());
    if (has_direct) direct = find_mesh_light(input.scene, input.caster, input.lattice, input.visible_lamps, lamp);
    add_to(seen, direct);
    add_to(seen, caustics);
    const std::vector<vec3> gathered = gather_at_nodes(input, {lamp, light, seen}, progress);
    std::copy(gathered.begin(), gathered.end(), light.begin());
    add_to(light, direct);
}

void smooth_all(const Lattice& lattice, std::span<vec3> light) {
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        smooth_nodes(lattice, uint(m), {.noise = noise_of_photons, .leaves_buried = false}, light);
    });
}

NodeIrradiance packed(const std::vector<vec3>& light) {
    float top = 0;
    for (const vec3& e : light) top = std::max(top, largest(e));
    NodeIrradiance irradiance{std::vector<uint>(light.size()),
                              top > 0 ? std::exp2(std::floor(std::log2(max_record / top))) : 1.0f};
    parallel_for(
        light.size(), [&](size_t i) { irradiance.records[i] = pack_rgb9e5(light[i] * irradiance.scale); }, 4096);
    return irradiance;
}

}  // namespace

NodeIrradiance gather_irradiance(const GatherInput& input, const PhotonGrids& caustics) {
    std::vector<vec3> light = estimate_from_photons(input.scene, input.lattice, input.photons.records);
    const std::vector<vec3> sharp = estimate_caustics(input.scene, input.lattice, caustics);
    const size_t nodes = input.lattice.nodes.size();
    Progress progress("final gathering", nodes * input.scene.lights.size());
    for (uint lamp = 0; lamp < input.scene.lights.size(); ++lamp) {
        const auto own = [&](auto& all) { return std::span(all).subspan(lamp * nodes, nodes); };
        gather_lamp(input, lamp, sharp.empty() ? std::span<const vec3>() : own(sharp), progress, own(light));
    }
    return packed(light);
}

NodeIrradiance smooth_irradiance(const Scene& scene, const Lattice& lattice, const PhotonRecords& photons) {
    std::vector<vec3> light = estimate_from_photons(scene, lattice, photons);
    const size_t nodes = lattice.nodes.size();
    for (uint lamp = 0; lamp < scene.lights.size(); ++lamp)
        smooth_all(lattice, std::span(light).subspan(lamp * nodes, nodes));
    return packed(light);
}

}  // namespace lw
