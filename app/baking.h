// Bakes a map while the user already walks: first a preview with few photons, then the full map, which is saved. Runs
// on a thread of its own; the caller polls for results.
#pragma once
#include <thread>

#include "base/progress.h"
#include "maps/photon_map.h"
#include "trace/ray_caster.h"

namespace lw {

class Baking {
  public:
    struct Settings {
        uint64_t preview_photons = 100'000;  // 0: no preview
        uint64_t photons = 1'000'000;
        std::filesystem::path output;  // where the full map is saved
    };

    /// Scene and caster must outlive it.
    Baking(const Scene& scene, const RayCaster& caster, Settings settings);
    /// Cancels what is still running and waits for it.
    ~Baking();
    Baking(const Baking&) = delete;
    Baking& operator=(const Baking&) = delete;

    /// Returns each finished map once: the preview, then the full one. Nothing when there is no new map.
    std::optional<PhotonMap> take();
    /// The name of the current step and how much of it is done, 0 to 1; nothing when all is done.
    std::optional<ProgressBoard::State> progress() const;
    /// The error since the last call, or "": a bake failed, or the map could not be saved.
    std::string take_message();

  private:
    void run();
    void bake(uint64_t photons, bool is_full);

    const Scene& scene_;
    const RayCaster& caster_;
    Settings settings_;
    ProgressBoard board_;
    mutable std::mutex mutex_;
    std::optional<PhotonMap> ready_;
    std::string message_;
    std::string renderer_;
    bool done_ = false;
    std::thread thread_;
};

}  // namespace lw
