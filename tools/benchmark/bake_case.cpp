#include "bake_case.h"

#include <algorithm>
#include <filesystem>

#include "file/map_file.h"
#include "maps/build.h"
#include "photons/shoot.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw {

std::vector<MeasuredMode> measured_modes() {
    const auto max_neighbours = [](uint mode) {
        if (mode == gather_mode_exact) return max_exact_neighbours;
        return mode == gather_mode_cached ? 50u : 1'000'000u;  // those of the cached mode are the bake's
    };
    std::vector<MeasuredMode> modes;
    for (const GatherMode& m : gather_modes) modes.push_back({m.name, m.mode, max_neighbours(m.mode)});
    const GatherMode& fastest = gather_mode(gather_mode_cached);
    modes.push_back({std::string(fastest.name) + ", no rays", fastest.mode, max_neighbours(fastest.mode), 0});
    return modes;
}

BakedCase::BakedCase(Scene made, const BakeSettings& settings, const std::filesystem::path& folder)
    : scene(std::move(made)), powers(lamp_powers(scene, {})) {
    const std::filesystem::path file = folder / "benchmark.pmap";
    cost.hierarchy = cost_of([&] { caster = std::make_unique<RayCaster>(scene); });
    const double before_mb = reset_peak_memory();
    // The two halves of bake(), which the sections time and whose photons they read.
    const ShootSettings shooting{
        .photons = settings.photons, .seed = settings.seed, .direct_in_photons = settings.direct_in_photons};
    cost.trace = cost_of([&] { photons = shoot_photons(scene, *caster, shooting); });
    cost.maps = cost_of([&] { map = build_photon_map(scene, *caster, photons, settings); });
    cost.write = cost_of([&] { save_photon_map(file, map); });
    cost.peak_memory_mb = peak_memory_mb();
    cost.added_memory_mb = cost.peak_memory_mb - before_mb;
    cost.file_bytes = std::filesystem::file_size(file);
    cost.load = cost_of([&] { map = load_photon_map(file, scene); });
    std::filesystem::remove(file);
}

double references_per_photon(const PhotonMap& map) {
    return double(map.places.size()) / double(std::max<uint64_t>(1, map.stored_photons));
}

double bytes_per_photon(const PhotonMap& map) {
    return double(map.bytes()) / double(std::max<uint64_t>(1, map.stored_photons));
}

CaseOnDevice::CaseOnDevice(const Device& device, const BakedCase& baked) : device_(device) {
    const Bvh bvh = baked.map.settings.direct_in_photons ? Bvh{} : build_bvh(baked.scene);
    resident_ = std::make_unique<Resident>(device, baked.scene, baked.map, bvh);
}

TimedFrame CaseOnDevice::render(const Camera& camera, FrameSize frame, const GatherSettings& gather) const {
    Renderer renderer(device_, *resident_, frame.width, frame.height);
    return {renderer.render(camera, {gather, std::nullopt, frame.views, frame.frames, true}), resident_->bytes()};
}

}  // namespace lw
