// One scene, baked, written, read again and rendered, with what each step cost. The only file of the benchmark that
// drives the engine from scene to picture; the sections ask it for cases and frames.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "gather/gather_pass.h"
#include "gather/renderer.h"
#include "maps/gather_settings.h"
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "table.h"
#include "timing.h"
#include "trace/ray_caster.h"

namespace lw {

/// A way to gather and the numbers of photons per estimate it is measured at.
struct MeasuredMode {
    std::string name;
    uint mode;            // GatherSettings::mode
    uint max_neighbours;  // that are measured
    uint shadow_rays = GatherSettings{}.shadow_rays;
};

/// All of gather_modes, and the default one without shadow rays; the sections iterate over this table.
std::vector<MeasuredMode> measured_modes();

struct BakeCost {
    Cost hierarchy, trace, maps, write, load;
    double peak_memory_mb = 0;   // of the process during trace, maps and write
    double added_memory_mb = 0;  // less what it held before: scene, hierarchy, device
    uint64_t file_bytes = 0;
};

/// A baked scene. Not movable: caster and map refer to the scene.
struct BakedCase {
    BakedCase(Scene made, const BakeSettings& settings, const std::filesystem::path& folder);
    BakedCase(const BakedCase&) = delete;

    Scene scene;
    std::unique_ptr<RayCaster> caster;
    Photons photons;
    PhotonMap map;
    std::vector<vec3> powers;  // RGB power of each lamp
    BakeCost cost;
};

double references_per_photon(const PhotonMap& map);
double bytes_per_photon(const PhotonMap& map);

struct FrameSize {
    uint width, height;
    uint frames = 1;  // times are their median
    uint views = 1;   // summed, through pixel centres; times are of all
};

struct TimedFrame {
    Rendering rendering;
    uint64_t device_bytes = 0;
    double total_ms() const {
        return rendering.times.visibility_ms + rendering.times.gather_ms + rendering.times.tonemap_ms;
    }
};

/// A baked case on a device; renders it at any size and with any gather.
class CaseOnDevice {
  public:
    CaseOnDevice(const Device& device, const BakedCase& baked);
    TimedFrame render(const Camera& camera, FrameSize frame, const GatherSettings& gather) const;
    uint64_t bytes() const { return resident_->bytes(); }
    /// What the shaders of a gather are compiled with.
    FrameConstants constants(const GatherSettings& gather) const { return constants_for(*resident_, gather); }
    uint64_t ray_bytes() const { return resident_->ray_bytes(); }

  private:
    const Device& device_;
    std::unique_ptr<Resident> resident_;
};

}  // namespace lw
